// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/triangle_pair.h"

#include <algorithm>

namespace pbrtmedia {
namespace {

/// Relative: corners nearer to a plane than this lie in it. Double rounding, far below float spacing.
constexpr double kCoplanar = 1e-12;
Vec3d faceVector(const std::array<Vec3d, 3>& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// Extent of a triangle's corners along the normal of a plane, 0 included; rounding is taken away.
struct Sides {
  double low = 0, high = 0;
  int inPlane = 0;  ///< corners
  Sides(const std::array<Vec3d, 3>& corners, Vec3d pointOfPlane, Vec3d normal, double scale) {
    const double tolerance = kCoplanar * scale * length(normal);
    for (const Vec3d& corner : corners) {
      const double side = dot(normal, corner - pointOfPlane);
      if (std::abs(side) <= tolerance) {
        ++inPlane;
      } else {
        low = std::min(low, side);
        high = std::max(high, side);
      }
    }
  }
};

}  // namespace

TrianglePair::TrianglePair(const std::array<Vec3d, 3>& excludedCorners,
                           const std::array<Vec3d, 3>& hitCorners, Vec3d rayDirection)
    : excluded(excludedCorners), hit(hitCorners), direction(rayDirection), scale(0) {
  for (const auto& corners : {excluded, hit}) {
    for (const Vec3d& corner : corners) scale = std::max(scale, maxComponent(abs(corner)));
  }
}

bool TrianglePair::deniesHit(bool isEnd) const {
  const Vec3d heading = isEnd ? -direction : direction;  // away from the excluded triangle
  const Vec3d hitNormal = faceVector(hit), excludedNormal = faceVector(excluded);
  const Sides start(excluded, hit[0], hitNormal, scale);
  const double across = dot(hitNormal, heading);
  if ((start.low == 0 && across >= 0) || (start.high == 0 && across <= 0)) return true;
  const Sides goal(hit, excluded[0], excludedNormal, scale);
  const double leaving = dot(excludedNormal, heading);
  return (goal.high == 0 && leaving >= 0) || (goal.low == 0 && leaving <= 0);
}

bool TrianglePair::isAdjacent() const { return Sides(excluded, hit[0], faceVector(hit), scale).inPlane >= 2; }

bool TrianglePair::isOneCrossing(Point2f uv, double rounding, bool isNear) const {
  const std::array<double, 3> weights{1.0 - uv.x - uv.y, uv.x, uv.y};
  const double size = std::sqrt(std::max(lengthSquared(hit[1] - hit[0]), lengthSquared(hit[2] - hit[0])));
  if (std::ranges::min(weights) * size > rounding) return false;
  const auto isShared = [](const std::array<Vec3d, 3>& corners, Vec3d p) {
    return std::ranges::find(corners, p) != corners.end();
  };
  std::array<bool, 3> shared{};
  double weightElsewhere = 0;  // of the corners that are not shared: 0 on the common edge or corner
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    shared[i] = isShared(excluded, hit[i]);
    if (shared[i]) ++count;
    if (!shared[i]) weightElsewhere += std::max(0.0, weights[i]);
  }
  if (count == 0 || count == 3 || weightElsewhere * size > rounding) return false;
  if (count == 1) {  // a corner: same facing, so the same passage
    return isNear && dot(faceVector(excluded), direction) * dot(faceVector(hit), direction) > 0;
  }
  // An edge: seen along the ray, the two lie on opposite sides of it.
  const std::size_t own = !shared[0] ? 0 : (!shared[1] ? 1 : 2);
  const auto other = std::ranges::find_if(excluded, [&](Vec3d p) { return !isShared(hit, p); });
  if (other == excluded.end()) return false;
  const Vec3d edge = hit[(own + 2) % 3] - hit[(own + 1) % 3];
  const Vec3d across = cross(edge, direction);
  const Vec3d base = hit[(own + 1) % 3];
  return dot(across, hit[own] - base) * dot(across, *other - base) < 0;
}

}  // namespace pbrtmedia
