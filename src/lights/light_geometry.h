// SPDX-License-Identifier: BSD-2-Clause
#pragma once

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

/// A ray from a light at one point along a unit direction.
inline LeSample emissionFromPoint(Point3f position, Vector3f direction, float time, Rgb intensity,
                                  float pdfDirection) {
  return {.ray = {.o = position, .d = direction, .time = time},
          .normal = direction,
          .radiance = intensity,
          .pdf = {.position = 1, .direction = pdfDirection}};
}

/// The sphere around the scene's box. Light from infinity enters it through discs of its radius that face the
/// light: every line that meets the scene crosses the disc of its direction.
class BoundingSphere {
 public:
  BoundingSphere() = default;  ///< of an empty scene: radius 0, nothing enters
  explicit BoundingSphere(const Bounds3f& box);

  double radius() const { return radius_; }
  /// A ray along unit `direction` that starts at a uniform point of the disc before the sphere.
  Ray entering(Vector3f direction, Point2f u, float time) const;
  /// Area density of `entering` for a ray of unit direction, wherever on its line it starts.
  float pdfEntering(const Ray& ray) const;

 private:
  Vec3d centre_{};
  double radius_ = 0;
};

}  // namespace pbrtmedia
