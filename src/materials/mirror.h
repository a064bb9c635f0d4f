// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/material.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Textures are borrowed; only those marked "may be null" may be.
struct MirrorParams {
  const RgbTexture* kr = nullptr;         ///< default 0.9
  const FloatTexture* bumpMap = nullptr;  ///< displacement along the normal, world units; may be null
};

/// Reflects perfectly, the same at every angle.
class MirrorMaterial final : public Material {
 public:
  /// Throws std::invalid_argument for a missing texture.
  explicit MirrorMaterial(const MirrorParams& params);
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override;

 private:
  MirrorParams params_;
};

}  // namespace pbrtmedia
