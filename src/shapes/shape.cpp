// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/shape.h"

namespace pbrtmedia {
namespace {

/// An area density at (p, n) as a solid-angle density at `reference`; 0 when it is not a finite number.
float solidAngleDensity(double areaDensity, Point3f reference, Point3f p, Normal3f n) {
  const Vec3d toPoint = Vec3d(p) - Vec3d(reference);
  const double distanceSquared = lengthSquared(toPoint);
  // d² / |cos| = d³ / |n . (p - reference)|
  const double pdf = areaDensity * distanceSquared * std::sqrt(distanceSquared) / absDot(Vec3d(n), toPoint);
  const auto rounded = static_cast<float>(pdf);
  return std::isfinite(rounded) ? rounded : 0;
}

}  // namespace

ShapeSample Shape::sample(std::uint32_t primitive, Point3f reference, Point2f u) const {
  ShapeSample s = sample(primitive, u);
  if (s.pdf > 0) s.pdf = solidAngleDensity(s.pdf, reference, s.p, s.n);
  return s;
}

double Shape::areaDensity(std::uint32_t primitive, Normal3f) const { return 1 / area(primitive); }

float Shape::pdf(std::uint32_t primitive, Point3f reference, Vector3f, Point3f p, Normal3f n) const {
  return solidAngleDensity(areaDensity(primitive, n), reference, p, n);
}

}  // namespace pbrtmedia
