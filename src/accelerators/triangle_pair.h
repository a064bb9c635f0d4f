// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>

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

  /// Whether a line that crosses the excluded triangle and hits the other one at barycentric (u, v), at
  /// nearly the same t, goes through an edge or corner that they share (up to `rounding`, a length) and
  /// passes from one side of the surface to the other once. (At a silhouette edge both are on one side of the
  /// line: two crossings or none.)
  bool isOneCrossing(Point2f uv, double rounding) const;

  std::array<Vec3d, 3> excluded, hit;
  Vec3d direction;
  double scale;  ///< largest coordinate
};

}  // namespace pbrtmedia
