// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/material.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Textures are borrowed. Absorption comes from the first that is there of sigmaA, color, and the melanins
/// (either may be null: none of it).
struct HairMaterialParams {
  const RgbTexture* sigmaA = nullptr;         ///< per radius of the fibre
  const RgbTexture* color = nullptr;          ///< of dense hair
  const FloatTexture* eumelanin = nullptr;    ///< concentration
  const FloatTexture* pheomelanin = nullptr;  ///< concentration
  const FloatTexture* eta = nullptr;          ///< default 1.55
  const FloatTexture* betaM = nullptr;        ///< in [0, 1]; default 0.3
  const FloatTexture* betaN = nullptr;        ///< in [0, 1]; default 0.3
  const FloatTexture* alpha = nullptr;        ///< degrees; default 2
};

/// Hair and fur: HairFibre, for curves, whose v runs across their width.
class HairMaterial final : public Material {
 public:
  /// Throws std::invalid_argument for a missing texture.
  explicit HairMaterial(const HairMaterialParams& params);
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override { return 1; }

 private:
  Rgb absorptionAt(const SurfaceInteraction& si, float betaN) const;

  HairMaterialParams params_;
};

}  // namespace pbrtmedia
