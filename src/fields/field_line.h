// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "base/bounds.h"
#include "base/interruption.h"
#include "base/segment.h"
#include "fields/closer_bounds.h"
#include "fields/density_line.h"
#include "fields/lattice_walk.h"
#include "fields/super_voxels.h"

namespace pbrtmedia {

/// A field that answers many points of a line faster than one after the other.
template <class Field>
concept BatchedField = requires(const Field& field, const LocalLine& line, std::span<const double> s,
                                std::span<float> out) {
  field.densities(line, s, out);
};

/// A field that can be cut where its density stops being smooth (PiecewiseCubicLine).
template <class Field>
concept PiecewiseCubicField = requires(const Field& field, const LocalLine& line, AnyIntervalVisitor visit) {
  field.walkPieces(line, 0.0, 1.0, visit);
};

/// The part of a segment inside a field (fields/density_line.h), in the field's local space and restarted
/// where it enters: s = t - tEntry(). So no number on it is larger than the field, however far away the
/// segment begins. Borrows field and bounds.
template <class Field>
class FieldLine {
 public:
  /// Nothing when the segment meets no density: it misses the occupied box, has no length there, or is not
  /// finite in the field's space. So every point of a line can be looked up.
  static std::optional<FieldLine> clip(const Field& field, const SuperVoxels& bounds,
                                       const Segment& segment) {
    const Bounds3d& box = bounds.occupied();
    if (!(segment.tMin < segment.tMax) || box.isEmpty()) return std::nullopt;
    LocalLine line;
    line.o = field.localFromWorld().point(Vec3d(segment.o));
    line.d = field.localFromWorld().vector(Vec3d(segment.d));
    line.inverse = {1 / line.d.x, 1 / line.d.y, 1 / line.d.z};
    double tMin = segment.tMin, tMax = segment.tMax;
    if (!clipToSlabs(box, line, tMin, tMax)) return std::nullopt;
    line.o = min(max(line.o + tMin * line.d, box.min), box.max);
    double length = tMax - tMin;
    // Far from the segment's origin t itself is coarse: then clip again from the entry, where it is not.
    if (!isNear(box, line.o + length * line.d)) {
      if (!isFinite(line.o) || !isFinite(line.d)) return std::nullopt;
      double begin = 0;
      clipToSlabs(box, line, begin, length);
    }
    // An infinite length is left only where the direction is zero: a point, not a line.
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    return FieldLine(field, bounds, line, length, tMin);
  }

  static constexpr bool hasProvenBounds() { return Field::kProvenBounds; }
  double tEntry() const { return tEntry_; }
  double length() const { return length_; }
  /// Where `s` is, in local units.
  Vec3d localPoint(double s) const { return line_.o + s * line_.d; }
  /// Every loop over a line looks up or draws in vain: here it is left when the run is to stop.
  float density(double s) const {
    leaveIfAbandoned();
    return field_->density(line_.o + s * line_.d);
  }
  void densities(std::span<const double> s, std::span<float> out) const {
    leaveIfAbandoned();
    if constexpr (BatchedField<Field>) {
      field_->densities(line_, s, out);
    } else {
      densitiesOneByOne(*this, s, out);
    }
  }
  /// From now on `walk` tells closer bounds (fields/closer_bounds.h) wherever a cell's own bound times the
  /// length crossed is above `column`. No effect on fields that cannot tell any.
  void refineAbove(double column) { refinedColumn_ = column; }
  bool isRefined() const { return refinedColumn_ < std::numeric_limits<double>::infinity(); }
  template <class Visit>
  void walk(Visit&& visit) const {
    if (isRefined()) [[unlikely]] {
      walkRefined(AnyVisit(visit));
    } else {
      bounds_->walk(line_, length_, visit);
    }
  }
  template <class Visit>
  requires PiecewiseCubicField<Field>
  void walkPieces(Visit&& visit) const {
    bool more = true;
    bounds_->walk(line_, length_, [&](double sEnter, double sExit, const SuperVoxel& bound) {
      if (bound.upper == 0) return true;
      field_->walkPieces(line_, sEnter, sExit, [&](double a, double b) { return more = visit(a, b); });
      return more;
    });
  }

 private:
  FieldLine(const Field& field, const SuperVoxels& bounds, const LocalLine& line, double length,
            double tEntry)
      : field_(&field), bounds_(&bounds), line_(line), length_(length), tEntry_(tEntry) {}

  void walkRefined(const AnyVisit& visit) const {
    const auto cells = [&](const auto& closer) {
      bounds_->walk(line_, length_, [&](double sEnter, double sExit, const SuperVoxel& bound) {
        return closer.isClose(bound, sExit - sEnter) ? visit(sEnter, sExit, bound)
                                                     : closer.refine(sEnter, sExit, bound);
      });
    };
    if constexpr (requires { field_->rangeOn(line_, 0.0, 1.0); }) {
      const Vec3d size = bounds_->cellSize();
      double cellLength = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < 3; ++i)
        cellLength = std::min(cellLength, std::abs(size[i] * line_.inverse[i]));
      cells(RangedBounds<Field>(*field_, line_, cellLength, refinedColumn_, visit));
    } else if constexpr (Field::kProvenBounds && PiecewiseCubicField<Field>) {
      cells(CubicBounds<Field>(*field_, line_, refinedColumn_, visit));
    } else {
      bounds_->walk(line_, length_, visit);
    }
  }

  /// Narrows [tMin, tMax] to the box; false when nothing is left. Random signs cost no branch here.
  static bool clipToSlabs(const Bounds3d& box, const LocalLine& line, double& tMin, double& tMax) {
    const auto clip = [&](double lo, double hi, double o, double inverse) {
      if (!(std::abs(inverse) < std::numeric_limits<double>::infinity())) return o >= lo && o <= hi;
      const double a = (lo - o) * inverse, b = (hi - o) * inverse;
      tMin = std::max(tMin, std::min(a, b));
      tMax = std::min(tMax, std::max(a, b));
      return true;
    };
    return clip(box.min.x, box.max.x, line.o.x, line.inverse.x) &&
           clip(box.min.y, box.max.y, line.o.y, line.inverse.y) &&
           clip(box.min.z, box.max.z, line.o.z, line.inverse.z) && tMin < tMax;
  }

  /// Fields answer safely up to this many local units outside their box.
  static constexpr double kSlack = 0.25;
  static bool isNear(const Bounds3d& box, Vec3d p) {
    return p.x >= box.min.x - kSlack && p.x <= box.max.x + kSlack && p.y >= box.min.y - kSlack &&
           p.y <= box.max.y + kSlack && p.z >= box.min.z - kSlack && p.z <= box.max.z + kSlack;
  }

  const Field* field_;
  const SuperVoxels* bounds_;
  LocalLine line_;  ///< from the entry point, in local units; d in local units per t
  double length_, tEntry_;
  double refinedColumn_ = std::numeric_limits<double>::infinity();
};

}  // namespace pbrtmedia
