// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/material.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Textures are borrowed; only those marked "may be null" may be.
struct MatteParams {
  const RgbTexture* kd = nullptr;         ///< default 0.5
  const FloatTexture* sigma = nullptr;    ///< degrees, clamped to [0, 90]; default 0
  const FloatTexture* bumpMap = nullptr;  ///< displacement along the normal, world units; may be null
};

/// Diffuse: Lambert for sigma 0, else Oren-Nayar.
class MatteMaterial final : public Material {
 public:
  /// Throws std::invalid_argument for a missing texture.
  explicit MatteMaterial(const MatteParams& params);
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override;

 private:
  MatteParams params_;
};

}  // namespace pbrtmedia
