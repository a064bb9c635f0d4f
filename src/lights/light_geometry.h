// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "base/bounds.h"
#include "lights/light.h"

namespace pbrtmedia {

/// The sample of a light at one point in space: direction, distance, pdf 1 and the radiance of an intensity
/// of 1 W/sr, 1/r². No sample (pdf 0) when the reference is the light's position.
inline LightSample sampleTowardPoint(Point3f position, Point3f reference) {
  const Vec3d d = Vec3d(position) - Vec3d(reference);  // double: the squared length cannot leave its range
  const double squared = lengthSquared(d);
  LightSample s;
  if (!(squared > 0)) return s;
  const double r = std::sqrt(squared);
  s.wi = Vector3f(d / r);
  s.distance = static_cast<float>(r);
  s.radiance = Rgb(static_cast<float>(1 / squared));
  s.pdf = 1;
  return s;
}

/// Map coordinates of a direction (any length) whose pole is +z: u = atan2(y, x)/2π in [0, 1), v = θ/π in [0,
/// 1] with θ from +z. Accurate next to the poles, where acos is not.
inline Point2f latLong(Vector3f w) {
  const float u = std::atan2(w.y, w.x) * kInv2Pi;
  return {std::min(u < 0 ? u + 1 : u, kOneMinusEpsilon), std::atan2(std::hypot(w.x, w.y), w.z) * kInvPi};
}

/// Radius of the sphere around the scene's box; 0 for an empty scene.
inline double boundingSphereRadius(const Bounds3f& box) {
  return box.isEmpty() ? 0 : length(Vec3d(box.max) - Vec3d(box.min)) / 2;
}

}  // namespace pbrtmedia
