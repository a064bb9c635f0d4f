// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/material.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Complex index of copper, PBRT-v3's default metal, in its RGB.
inline constexpr Rgb kCopperEta{0.19999f, 0.92209f, 1.09988f};
inline constexpr Rgb kCopperK{3.90464f, 2.44763f, 2.13765f};

/// Textures are borrowed; only those marked "may be null" may be.
struct MetalParams {
  const RgbTexture* eta = nullptr;           ///< default kCopperEta
  const RgbTexture* k = nullptr;             ///< default kCopperK
  const FloatTexture* roughness = nullptr;   ///< default 0.01; may be null when both below are given
  const FloatTexture* uRoughness = nullptr;  ///< may be null: roughness
  const FloatTexture* vRoughness = nullptr;  ///< may be null: roughness
  bool remapRoughness = true;
  const FloatTexture* bumpMap = nullptr;  ///< displacement along the normal, world units; may be null
};

/// A rough conductor; never a true mirror.
class MetalMaterial final : public Material {
 public:
  /// Throws std::invalid_argument for a missing texture.
  explicit MetalMaterial(const MetalParams& params);
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override;

 private:
  MetalParams params_;
};

}  // namespace pbrtmedia
