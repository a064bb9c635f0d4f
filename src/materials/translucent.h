// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/material.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Textures are borrowed; only those marked "may be null" may be.
struct TranslucentParams {
  const RgbTexture* kd = nullptr;           ///< default 0.25
  const RgbTexture* ks = nullptr;           ///< default 0.25
  const RgbTexture* reflect = nullptr;      ///< default 0.5
  const RgbTexture* transmit = nullptr;     ///< default 0.5
  const FloatTexture* roughness = nullptr;  ///< default 0.1
  bool remapRoughness = true;
  const FloatTexture* bumpMap = nullptr;  ///< displacement along the normal, world units; may be null
};

/// A thin rough dielectric sheet of index 1.5 that scatters diffusely and glossily to both sides.
class TranslucentMaterial final : public Material {
 public:
  /// Throws std::invalid_argument for a missing texture.
  explicit TranslucentMaterial(const TranslucentParams& params);
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override;

 private:
  TranslucentParams params_;
};

}  // namespace pbrtmedia
