// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/transform.h"

namespace pbrtmedia {

/// Directions between a light's own space and the world, and what that does to solid angles. A transform that
/// scales unevenly is followed exactly. Immutable, thread-safe.
class LightDirections {
 public:
  /// Throws std::invalid_argument, naming `light`, when the transform has no inverse.
  LightDirections(const Transform& worldFromLight, const char* light);

  /// Unit; `light` of any length.
  Vector3f toWorld(Vector3f light) const { return normalize(worldFromLight_.vector(light)); }
  /// Of another length, unless the transform is rigid.
  Vector3f toLight(Vector3f world) const { return lightFromWorld_.vector(world); }
  const Affine3f& lightFromWorld() const { return lightFromWorld_; }
  /// d(solid angle in light space) / d(solid angle in world space) at a unit world direction.
  float jacobian(Vector3f world) const;

 private:
  Affine3f worldFromLight_, lightFromWorld_;
  float inverseDeterminant_;  ///< |det| of lightFromWorld_
  bool keepsSolidAngles_;     ///< the transform is a rotation, a mirror or an even scale of one
};

}  // namespace pbrtmedia
