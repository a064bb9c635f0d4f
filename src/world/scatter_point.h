// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/ray.h"
#include "base/statistics.h"
#include "base/vec.h"

namespace pbrtmedia {

/// A plane that a path vertex in a medium must stay on one side of: the boundary at either end of its
/// segment.
struct BoundaryPlane {
  bool isValid = false;
  Vec3d p{};
  Vec3d n{};          ///< unit, toward the side of the segment
  double scale = 0;   ///< the largest coordinate that the surface is computed from
  double offset = 0;  ///< >= 0: true heights above the boundary are less than those above the plane by this

  double heightOf(Vec3d q) const { return dot(q - p, n); }
};

/// Where a path scatters in a medium: a point of single precision, as ray queries want it, safely on its side
/// of the boundary. Under a large extinction what comes back out of a medium has hardly gone in, by less than
/// single precision tells: so the true height above a boundary close by is kept apart, and a segment that
/// leaves through it ends where it would from there. Displacements by some float spacings across the boundary
/// remain; they show nowhere.
struct ScatterPoint {
  Point3f p;           ///< world
  BoundaryPlane near;  ///< the boundary close by, if there is one
  double height = 0;   ///< of the true point above the boundary, >= 0; p's own is larger by near.offset

  /// Where the segment along unit `d` ends when the ray from p meets a surface at `t`: sooner, if that is the
  /// boundary close by.
  double endAlong(Vector3f d, double t) const;
};

/// The point at `t` of a segment that begins and ends at these boundaries. It is moved to the right side of a
/// close one by some float spacings; being beyond it counts as a repair.
ScatterPoint scatterPoint(const Ray& ray, double t, const BoundaryPlane& start, const BoundaryPlane& end,
                          RenderCounters& counters);

/// Counts the latest scatterings of a path whose flights coordinates could not tell from none.
class ScatteringsInPlace {
 public:
  /// Whether a path that flew from `from` to `at` would scatter there for ever: after so many in one place
  /// free flights are far shorter than coordinates can tell (were they as long as a hundredth of that, one in
  /// 1e50 would stay). Close to a boundary, heights above it are told far better, and paths come out sooner
  /// or later.
  bool isStuck(Point3f from, const ScatterPoint& at) {
    count_ = at.p == from ? count_ + 1 : 0;
    return count_ > (at.near.isValid ? kMostAtBoundary : kMost);
  }

 private:
  static constexpr int kMost = 1024, kMostAtBoundary = 1 << 20;
  int count_ = 0;
};

/// A scattering closer to the end of its segment than this share of the largest coordinate is looked at by
/// `scatterPoint`; farther away only a boundary met at less than about 1e-3 radians could be within rounding.
constexpr double kNearBoundary = 1e-3;

}  // namespace pbrtmedia
