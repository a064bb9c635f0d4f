// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/vec.h"

// Internal to the room: other rooms see accelerator.h only.

namespace pbrtmedia {

/// A triangle that a ray must not report, and another one that it may have hit only because of rounding. Both
/// and the ray's direction in one space.
struct TrianglePair {
  TrianglePair(const std::array<Vec3d, 3>& excludedCorners, const std::array<Vec3d, 3>& hitCorners,
               Vec3d rayDirection);

  /// Whether a ray that starts (or ends: `isEnd`) on the excluded triangle cannot hit the other near there.
  ///
  /// The stored end is rounded, so it may lie beside the excluded triangle or on the wrong side of the other
  /// one. But the true end lies on the one, the true hit on the other, and the ray leads from the first to
  /// the second: so where one triangle lies on one side of the other's plane (or in it), the ray must cross
  /// that plane in that direction. When the triangles cut each other nothing is denied.
  bool deniesHit(bool isEnd) const;

  /// Whether the excluded triangle has an edge in the plane of the other one.
  bool isAdjacent() const;

  /// Whether a line that crosses the excluded triangle and hits the other one at barycentric (u, v)
  /// goes through an edge or corner that they share (up to `rounding`, a length) and
  /// passes from one side of the surface to the other once. (At a silhouette edge both are on one side of the
  /// line: two crossings or none.)
  /// Through an edge that may be at any distance between the hits, as a line may graze one of the two; a
  /// corner says less, and counts only where the hits are close (`isNear`).
  bool isOneCrossing(Point2f uv, double rounding, bool isNear) const;

  std::array<Vec3d, 3> excluded, hit;
  Vec3d direction;
  double scale;  ///< largest coordinate
};

/// An edge of a triangle and a line that passes it, in one space. All answers are the same for the two
/// directions of the edge, up to signs.
struct SilhouetteEdge {
  Vec3d a, b, origin, direction;

  /// Of the line from the edge's line; NaN if they are parallel.
  double distance() const {
    const Vec3d across = cross(b - a, direction);
    return std::abs(dot(across, origin - a)) / length(across);
  }
  /// The largest coordinate.
  double scale() const {
    return std::max({maxComponent(abs(a)), maxComponent(abs(b)), maxComponent(abs(origin))});
  }
  /// On which side of the edge a point is seen along the line, by sign.
  double side(Vec3d p) const { return dot(cross(b - a, direction), p - a); }
  /// The third corner of a triangle that has this edge.
  std::optional<Vec3d> apexOf(const std::array<Vec3d, 3>& triangle) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d p = triangle[(i + 1) % 3], q = triangle[(i + 2) % 3];
      if ((p == a && q == b) || (p == b && q == a)) return triangle[i];
    }
    return std::nullopt;
  }
};

}  // namespace pbrtmedia
