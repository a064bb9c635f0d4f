// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/bounds.h"
#include "base/segment.h"
#include "fields/density_line.h"
#include "fields/super_voxels.h"

namespace pbrtmedia {

/// The part of a segment inside a field (fields/density_line.h), in the field's local space and restarted
/// where it enters: s = t - tEntry(). So no number on it is larger than the field, however far away the
/// segment begins. Borrows field and bounds.
template <class Field>
class FieldLine {
 public:
  static constexpr bool kProvenBounds = Field::kProvenBounds;

  /// Nothing when the segment meets no density: it misses the occupied box, or has no length there.
  static std::optional<FieldLine> clip(const Field& field, const SuperVoxels& bounds,
                                       const Segment& segment) {
    const Bounds3d& box = bounds.occupied();
    if (!(segment.tMin < segment.tMax) || box.isEmpty()) return std::nullopt;
    const Vec3d o = field.localFromWorld().point(Vec3d(segment.o));
    const Vec3d d = field.localFromWorld().vector(Vec3d(segment.d));
    const auto inside = clipToBox(box, o, d, segment.tMin, segment.tMax);
    if (!inside) return std::nullopt;
    const Vec3d entry = min(max(o + inside->tMin * d, box.min), box.max);
    double length = inside->tMax - inside->tMin;
    // Far from the segment's origin t itself is coarse: then clip again from the entry, where it is not.
    if (!isNear(box, entry + length * d)) {
      const auto again = clipToBox(box, entry, d, 0.0, length);
      length = again ? again->tMax : 0;
    }
    // An infinite length is left only where the direction is zero: a point, not a line.
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    return FieldLine(field, bounds, entry, d, length, inside->tMin);
  }

  double tEntry() const { return tEntry_; }
  double length() const { return length_; }
  float density(double s) const { return field_->density(o_ + s * d_); }
  template <class Visit>
  void walk(Visit&& visit) const {
    bounds_->walk(o_, d_, 0.0, length_, visit);
  }
  template <class Visit>
  void walkPieces(Visit&& visit) const {
    bool more = true;
    bounds_->walk(o_, d_, 0.0, length_, [&](double sEnter, double sExit, const SuperVoxel& bound) {
      if (bound.upper == 0) return true;
      field_->walkPieces(o_, d_, sEnter, sExit, [&](double a, double b) { return more = visit(a, b); });
      return more;
    });
  }

 private:
  FieldLine(const Field& field, const SuperVoxels& bounds, Vec3d o, Vec3d d, double length, double tEntry)
      : field_(&field), bounds_(&bounds), o_(o), d_(d), length_(length), tEntry_(tEntry) {}

  /// Fields answer safely up to this many local units outside their box.
  static constexpr double kSlack = 0.25;
  static bool isNear(const Bounds3d& box, Vec3d p) {
    return p.x >= box.min.x - kSlack && p.x <= box.max.x + kSlack && p.y >= box.min.y - kSlack &&
           p.y <= box.max.y + kSlack && p.z >= box.min.z - kSlack && p.z <= box.max.z + kSlack;
  }

  const Field* field_;
  const SuperVoxels* bounds_;
  Vec3d o_, d_;  ///< entry point in local units; local units per t
  double length_, tEntry_;
};

}  // namespace pbrtmedia
