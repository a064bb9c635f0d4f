// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "accelerators/accelerator.h"
#include "shapes/surface_interaction.h"
#include "world/primitive.h"

namespace pbrtmedia {

/// Which hits of a primitive exist: not where its alpha texture is exactly 0; for occlusion rays, neither
/// where shadowalpha is 0 nor at all when it has no material (scene-language reference 13.9). Textures are
/// evaluated without a footprint, at (u, v) and, on meshes, at the point.
class AlphaFilter final : public HitFilter {
 public:
  /// `primitive` is borrowed.
  explicit AlphaFilter(const Primitive& primitive);
  bool accepts(const RayHit& hit, bool shadowRay) const override;
  /// False: every hit exists, no filter is needed.
  static bool isNeeded(const Primitive& primitive) {
    return primitive.alpha || primitive.shadowAlpha || !primitive.material;
  }

 private:
  SurfaceInteraction pointAt(const RayHit& hit) const;
  const Primitive& primitive_;
  std::optional<TriangleBuffers> triangles_;
};

}  // namespace pbrtmedia
