// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/material.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Textures are borrowed; only those marked "may be null" may be.
struct SubstrateParams {
  const RgbTexture* kd = nullptr;            ///< default 0.5
  const RgbTexture* ks = nullptr;            ///< default 0.5
  const FloatTexture* uRoughness = nullptr;  ///< default 0.1
  const FloatTexture* vRoughness = nullptr;  ///< default 0.1
  bool remapRoughness = true;
  const FloatTexture* bumpMap = nullptr;  ///< displacement along the normal, world units; may be null
};

/// A glossy coat over a diffuse base (`FresnelBlend`).
class SubstrateMaterial final : public Material {
 public:
  /// Throws std::invalid_argument for a missing texture.
  explicit SubstrateMaterial(const SubstrateParams& params);
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override;

 private:
  SubstrateParams params_;
};

}  // namespace pbrtmedia
