// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "image/mip_map.h"
#include "textures/mapping2d.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// How texels are made from a picture: the parameters that two textures of one file must share to share a
/// pyramid.
struct ImageTexelParams {
  bool gamma = false;  ///< decode the sRGB curve; see `defaultGamma`
  float scale = 1;     ///< multiplies after decoding
  WrapMode wrap = WrapMode::Repeat;
};

/// "gamma" where the scene does not say: true for names ending in .png or .tga (any case).
bool defaultGamma(const std::filesystem::path& filename);

/// Texels with t = 0 at the *bottom* row. T = float decodes the luminance of the stored RGB, as PBRT-v3 does,
/// which is not the luminance of the decoded RGB.
template <class T>
std::shared_ptr<const MipMap<T>> makeTexturePyramid(const Image& image, const ImageTexelParams& params);

struct ImageFilterParams {
  bool trilinear = false;      ///< false: elliptical weighted average
  float maxAnisotropy = 8.0f;  ///< EWA only; [1, 1024]
};

/// A picture on the unit square of (s, t). T is float or Rgb. Without ray differentials: bilinear at the
/// finest level.
template <class T>
class ImageTexture final : public Texture<T> {
 public:
  /// `pyramid` may be shared between textures. Throws std::invalid_argument for a null pyramid or an
  /// anisotropy limit out of range.
  ImageTexture(const Mapping2d& mapping, std::shared_ptr<const MipMap<T>> pyramid,
               const ImageFilterParams& filter = {});
  T evaluate(const SurfaceInteraction& si) const override;

 private:
  Mapping2d mapping_;
  std::shared_ptr<const MipMap<T>> pyramid_;
  ImageFilterParams filter_;
};

extern template class ImageTexture<float>;
extern template class ImageTexture<Rgb>;

}  // namespace pbrtmedia
