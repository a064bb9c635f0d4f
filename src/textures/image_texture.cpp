// SPDX-License-Identifier: BSD-2-Clause
#include "textures/image_texture.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace pbrtmedia {

namespace {

/// A footprint's longest EWA axis is at most this many times 2 texels: a bound on the cost of one lookup.
constexpr float kLargestAnisotropy = 1024;

template <class T>
T texelFrom(Rgb stored, const ImageTexelParams& params) {
  const auto decode = [&](float c) { return params.scale * (params.gamma ? decodeSrgb(c) : c); };
  if constexpr (std::is_same_v<T, float>) {
    return decode(stored.luminance());
  } else {
    return {decode(stored.r), decode(stored.g), decode(stored.b)};
  }
}

}  // namespace

bool defaultGamma(const std::filesystem::path& filename) {
  std::string extension = filename.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".tga";
}

template <class T>
std::shared_ptr<const MipMap<T>> makeTexturePyramid(const Image& image, const ImageTexelParams& params) {
  std::vector<T> texels;
  texels.reserve(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  for (int y = image.height() - 1; y >= 0; --y) {
    for (int x = 0; x < image.width(); ++x) texels.push_back(texelFrom<T>(image.rgb(x, y), params));
  }
  return std::make_shared<const MipMap<T>>(image.width(), image.height(), std::move(texels), params.wrap);
}

template std::shared_ptr<const MipMap<float>> makeTexturePyramid(const Image&, const ImageTexelParams&);
template std::shared_ptr<const MipMap<Rgb>> makeTexturePyramid(const Image&, const ImageTexelParams&);

template <class T>
ImageTexture<T>::ImageTexture(const Mapping2d& mapping, std::shared_ptr<const MipMap<T>> pyramid,
                              const ImageFilterParams& filter)
    : mapping_(mapping), pyramid_(std::move(pyramid)), filter_(filter) {
  if (pyramid_ == nullptr) throw std::invalid_argument("texture \"imagemap\": no image");
  if (!(filter.maxAnisotropy >= 1 && filter.maxAnisotropy <= kLargestAnisotropy)) {
    throw std::invalid_argument("texture \"imagemap\": maxanisotropy must be in [1, 1024], found " +
                                std::to_string(filter.maxAnisotropy));
  }
}

template <class T>
T ImageTexture<T>::evaluate(const SurfaceInteraction& si) const {
  const auto [st, dstdx, dstdy] = mapPoint(mapping_, si);
  if (!filter_.trilinear) return pyramid_->ewa(st, dstdx, dstdy, filter_.maxAnisotropy);
  const float width = std::max(std::max(std::abs(dstdx.x), std::abs(dstdx.y)),
                               std::max(std::abs(dstdy.x), std::abs(dstdy.y)));
  return pyramid_->trilinear(st, width);
}

template class ImageTexture<float>;
template class ImageTexture<Rgb>;

}  // namespace pbrtmedia
