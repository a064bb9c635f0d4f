// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/material.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Textures are borrowed; only those marked "may be null" may be.
struct PlasticParams {
  const RgbTexture* kd = nullptr;           ///< default 0.25
  const RgbTexture* ks = nullptr;           ///< default 0.25
  const FloatTexture* roughness = nullptr;  ///< default 0.1
  bool remapRoughness = true;
  const FloatTexture* bumpMap = nullptr;  ///< displacement along the normal, world units; may be null
};

/// Lambert plus a glossy dielectric lobe. As in PBRT-v3 the indices are exchanged: 1.5 on the normal's side,
/// 1 behind it, so reflection is total beyond a half-angle of 41.8 degrees.
class PlasticMaterial final : public Material {
 public:
  /// Throws std::invalid_argument for a missing texture.
  explicit PlasticMaterial(const PlasticParams& params);
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override;

 private:
  PlasticParams params_;
};

}  // namespace pbrtmedia
