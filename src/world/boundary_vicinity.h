// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <deque>
#include <vector>

#include "base/bounds.h"
#include "world/primitive.h"

namespace pbrtmedia {

class Placement;

/// Answers quickly, and for most points of most scenes with no, whether a point may lie on a boundary of
/// media: by the boxes of boundaries, the planes of small meshes, and the surfaces of spheres. Immutable,
/// thread-safe.
class BoundaryVicinity {
 public:
  /// `groups`: primitives placed directly, then those of every object.
  BoundaryVicinity(const std::vector<std::vector<const Primitive*>>& groups,
                   const std::deque<Placement>& placements);
  /// False only if every boundary is farther from `p` (world) than rounding, at all times. One of them, which
  /// holds it, may be left out: `own` as it is placed.
  bool mayHold(Point3f p, const Primitive* own = nullptr, const Placement* placement = nullptr) const {
    if (isUnknown_) return true;
    for (const Item& item : items_) {
      if (!item.reach.contains(p) || (item.boundary == own && item.placement == placement)) continue;
      if (item.mayHold(p)) return true;
    }
    return false;
  }

 private:
  struct Plane {
    Vec3d n;  ///< unit
    double offset;
  };
  struct Item {
    const Primitive* boundary;
    const Placement* placement;
    Bounds3f box;                 ///< world
    Bounds3f reach{};             ///< outside it is no point that `mayHold` is true of
    double extent = 0;            ///< largest coordinate that had a part in its world positions
    double radius = 0;            ///< of a sphere around the middle of the box; 0: none
    std::vector<Plane> planes{};  ///< empty: not known
    bool mayHold(Point3f p) const;
  };
  void add(const Primitive& boundary, const Placement* placement);

  std::vector<Item> items_;
  bool isUnknown_ = false;  ///< too many to ask
};

}  // namespace pbrtmedia
