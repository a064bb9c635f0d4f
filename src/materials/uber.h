// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/material.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Textures are borrowed; only those marked "may be null" may be.
struct UberParams {
  const RgbTexture* kd = nullptr;            ///< default 0.25
  const RgbTexture* ks = nullptr;            ///< glossy; default 0.25
  const RgbTexture* kr = nullptr;            ///< perfectly specular; default 0
  const RgbTexture* kt = nullptr;            ///< perfectly specular; default 0
  const RgbTexture* opacity = nullptr;       ///< default 1
  const FloatTexture* roughness = nullptr;   ///< default 0.1; may be null when uRoughness is given
  const FloatTexture* uRoughness = nullptr;  ///< may be null: roughness
  const FloatTexture* vRoughness = nullptr;  ///< may be null: the u value
  const FloatTexture* eta = nullptr;         ///< > 0; default 1.5
  bool remapRoughness = true;
  const FloatTexture* bumpMap = nullptr;  ///< displacement along the normal, world units; may be null
};

/// Diffuse, glossy and perfectly specular lobes, all multiplied by the opacity; what is left goes straight
/// through, unrefracted.
class UberMaterial final : public Material {
 public:
  /// Throws std::invalid_argument for a missing texture.
  explicit UberMaterial(const UberParams& params);
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override;

 private:
  UberParams params_;
};

}  // namespace pbrtmedia
