// SPDX-License-Identifier: BSD-2-Clause
#include "lights/light_geometry.h"

#include <numbers>

#include "base/warp.h"

namespace pbrtmedia {

BoundingSphere::BoundingSphere(const Bounds3f& box) {
  if (box.isEmpty()) return;
  centre_ = (Vec3d(box.min) + Vec3d(box.max)) / 2.0;
  radius_ = length(Vec3d(box.max) - Vec3d(box.min)) / 2;
}

Ray BoundingSphere::entering(Vector3f direction, Point2f u, float time) const {
  const Vec3d d(direction);
  const auto [x, y] = coordinateSystem(d);
  const Point2f disc = sampleConcentricDisk(u);
  const Vec3d o = centre_ + radius_ * (double{disc.x} * x + double{disc.y} * y - d);
  return {.o = Point3f(o), .d = direction, .time = time};
}

float BoundingSphere::pdfEntering(const Ray& ray) const {
  const Vec3d d(ray.d), from = Vec3d(ray.o) - centre_, across = from - dot(from, d) * d;
  if (!(radius_ > 0) || lengthSquared(across) > sqr(radius_)) return 0;
  return static_cast<float>(1 / (std::numbers::pi * sqr(radius_)));
}

}  // namespace pbrtmedia
