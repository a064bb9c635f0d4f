// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <optional>

#include "base/bounds.h"
#include "base/segment.h"
#include "fields/density_line.h"
#include "fields/super_voxels.h"

namespace pbrtmedia {

/// The part of a segment inside a field, in the field's local space (fields/density_line.h). Borrows field
/// and bounds.
template <class Field>
class FieldLine {
 public:
  static constexpr bool kProvenBounds = Field::kProvenBounds;

  /// Nothing when the segment meets no density: it misses the occupied box, or has no length.
  static std::optional<FieldLine> clip(const Field& field, const SuperVoxels& bounds, const Segment& s) {
    if (!(s.tMin < s.tMax) || bounds.occupied().isEmpty()) return std::nullopt;
    const Vec3d o = field.localFromWorld().point(Vec3d(s.o)), d = field.localFromWorld().vector(Vec3d(s.d));
    const auto inside = clipToBox(bounds.occupied(), o, d, s.tMin, s.tMax);
    // A direction of length 0 inside the box leaves an infinite segment infinite: it is a point, not a line.
    if (!inside || !(inside->tMin < inside->tMax) || !std::isfinite(inside->tMax)) return std::nullopt;
    return FieldLine(field, bounds, o, d, inside->tMin, inside->tMax);
  }

  double tMin() const { return tMin_; }
  double tMax() const { return tMax_; }
  float density(double t) const { return field_->density(o_ + t * d_); }
  template <class Visit>
  void walk(Visit&& visit) const {
    bounds_->walk(o_, d_, tMin_, tMax_, visit);
  }
  template <class Visit>
  void walkPieces(Visit&& visit) const {
    bool more = true;
    bounds_->walk(o_, d_, tMin_, tMax_, [&](double tEnter, double tExit, const SuperVoxel& bound) {
      if (bound.upper == 0) return true;
      field_->walkPieces(o_, d_, tEnter, tExit, [&](double a, double b) { return more = visit(a, b); });
      return more;
    });
  }

 private:
  FieldLine(const Field& field, const SuperVoxels& bounds, Vec3d o, Vec3d d, double tMin, double tMax)
      : field_(&field), bounds_(&bounds), o_(o), d_(d), tMin_(tMin), tMax_(tMax) {}

  const Field* field_;
  const SuperVoxels* bounds_;
  Vec3d o_, d_;  ///< local units per t
  double tMin_, tMax_;
};

}  // namespace pbrtmedia
