// SPDX-License-Identifier: BSD-2-Clause
#include "world/scatter_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pbrtmedia {
namespace {

/// Rounding of a point's coordinates and of a hit's distance to its plane, in float spacings of the largest
/// coordinate involved: half a spacing per coordinate each, with room for the few operations of a triangle
/// test.
constexpr double kRoundingSpacings = 8;
constexpr double kSpacing = 0x1p-23;
/// Of the margin: a boundary farther away is forgotten, with what is still displaced across it.
constexpr double kForgotten = 64;

/// Whether two planes are one boundary seen twice, the second time perhaps where segments end by its offset.
bool isSame(const BoundaryPlane& a, const BoundaryPlane& b, double margin) {
  const double height = a.heightOf(b.p);
  return dot(a.n, b.n) > 0.999 && height >= -margin && height <= a.offset + margin;
}

}  // namespace

ScatterPoint scatterPoint(const Ray& ray, double t, const BoundaryPlane& start, const BoundaryPlane& end,
                          RenderCounters& counters) {
  const Vec3d exact = Vec3d(ray.o) + t * Vec3d(ray.d);
  ScatterPoint at;
  at.p = Point3f(exact);
  const double largest{std::max(maxComponent(abs(at.p)), maxComponent(abs(ray.o)))};
  Vec3d moved = exact;
  double lowest = std::numeric_limits<double>::infinity();
  for (const BoundaryPlane* plane : {&start, &end}) {
    if (!plane->isValid) continue;
    const double scale = std::max(largest, plane->scale), margin = kRoundingSpacings * kSpacing * scale;
    if (plane == &end && at.near.isValid && isSame(at.near, end, margin)) continue;
    // Far along a grazing segment the plane says nothing about the surface.
    if (!(lengthSquared(exact - plane->p) < sqr(kNearBoundary * scale))) continue;
    const double height = plane->heightOf(exact);
    if (height - plane->offset <= 0) ++counters.boundaryRepairs;
    if (height < margin) moved += (margin - plane->heightOf(moved)) * plane->n;
    if (height < kForgotten * margin && height < lowest) {
      lowest = height;
      at.near = *plane;
      at.height = std::max(height - plane->offset, 0.0);
    }
  }
  at.p = Point3f(moved);
  if (at.near.isValid) at.near.offset = std::max(at.near.heightOf(Vec3d(at.p)) - at.height, 0.0);
  return at;
}

double ScatterPoint::endAlong(Vector3f d, double t) const {
  const double fall = near.isValid ? -dot(Vec3d(d), near.n) : 0, own = height + near.offset;
  // Another surface may be in between, or the boundary may be curved.
  if (!(fall > 0) || std::abs(t * fall - own) > own / 2) return t;
  return std::min(height / fall, t);
}

}  // namespace pbrtmedia
