// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/material.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Textures are borrowed; only those marked "may be null" may be.
struct GlassParams {
  const RgbTexture* kr = nullptr;            ///< default 1
  const RgbTexture* kt = nullptr;            ///< default 1
  const FloatTexture* eta = nullptr;         ///< index behind the normal, > 0; default 1.5
  const FloatTexture* uRoughness = nullptr;  ///< default 0
  const FloatTexture* vRoughness = nullptr;  ///< default 0; both 0: perfectly smooth
  bool remapRoughness = true;
  const FloatTexture* bumpMap = nullptr;  ///< displacement along the normal, world units; may be null
};

/// A dielectric boundary, smooth or rough. No absorption inside: that is a medium.
class GlassMaterial final : public Material {
 public:
  /// Throws std::invalid_argument for a missing texture.
  explicit GlassMaterial(const GlassParams& params);
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override;

 private:
  GlassParams params_;
};

}  // namespace pbrtmedia
