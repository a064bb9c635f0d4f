// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "base/interruption.h"
#include "fields/clipped_line.h"
#include "fields/closer_bounds.h"
#include "fields/density_line.h"
#include "fields/field_bounds.h"

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

/// A field on a clipped line: the DensityLine of the renderer. Borrows the field and its bounds.
template <class Field>
class FieldLine : public ClippedLine {
 public:
  FieldLine(const Field& field, const FieldBounds& bounds, const ClippedLine& line)
      : ClippedLine(line), field_(&field), learned_(bounds.learned()), areProven_(bounds.areProven()) {}

  static std::optional<FieldLine> clip(const Field& field, const FieldBounds& bounds,
                                       const Segment& segment) {
    const auto line = ClippedLine::clip(field.localFromWorld(), bounds.inForce(), segment);
    if (!line) return std::nullopt;
    return FieldLine(field, bounds, *line);
  }

  bool hasProvenBounds() const { return areProven_; }
  FieldLine stretch(double sEnter, double sExit) const {
    FieldLine part = *this;
    static_cast<ClippedLine&>(part) = ClippedLine::stretch(sEnter, sExit);
    return part;
  }
  /// Every loop over a line looks up or draws in vain: here it is left when the run is to stop.
  float density(double s) const {
    leaveIfAbandoned();
    const Vec3d p = pointAt(s);
    const float density = field_->density(p);
    return learned_ != nullptr ? learned_->bounded(p, density) : density;
  }
  void densities(std::span<const double> s, std::span<float> out) const {
    leaveIfAbandoned();
    if constexpr (BatchedField<Field>) {
      field_->densities(local(), s, out);
      if (learned_ == nullptr) return;
      for (std::size_t i = 0; i < s.size(); ++i) out[i] = learned_->bounded(pointAt(s[i]), out[i]);
    } else {
      densitiesOneByOne(*this, s, out);
    }
  }
  /// Where a cell's own bound times the length crossed is above `refinedColumn` it tells closer bounds
  /// (fields/closer_bounds.h), if bounds are proven and the field can tell any.
  template <class Visit>
  void walk(Visit&& visit) const {
    if (isRefined() && areProven_) [[unlikely]] {
      walkRefined(AnyVisit(visit));
    } else {
      walkCells(visit);
    }
  }
  /// Call only if bounds are proven: a density that is cut to bounds is no cubic.
  template <class Visit>
  requires PiecewiseCubicField<Field>
  void walkPieces(Visit&& visit) const {
    bool more = true;
    walkCells([&](double sEnter, double sExit, const SuperVoxel& bound) {
      if (bound.upper == 0) return true;
      field_->walkPieces(local(), sEnter, sExit, [&](double a, double b) { return more = visit(a, b); });
      return more;
    });
  }

 private:
  void walkRefined(const AnyVisit& visit) const {
    const auto refined = [&](const auto& closer) {
      walkCells([&](double sEnter, double sExit, const SuperVoxel& bound) {
        return closer.isClose(bound, sExit - sEnter) ? visit(sEnter, sExit, bound)
                                                     : closer.refine(sEnter, sExit, bound);
      });
    };
    if constexpr (requires { field_->rangeOn(local(), 0.0, 1.0); }) {
      const Vec3d size = cells().cellSize();
      double cellLength = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < 3; ++i)
        cellLength = std::min(cellLength, std::abs(size[i] * local().inverse[i]));
      refined(RangedBounds<Field>(*field_, local(), cellLength, refinedColumn(), visit));
    } else if constexpr (PiecewiseCubicField<Field>) {
      refined(CubicBounds<Field>(*field_, local(), refinedColumn(), visit));
    } else {
      walkCells(visit);
    }
  }

  const Field* field_;
  LearnedBounds* learned_;
  bool areProven_;
};

}  // namespace pbrtmedia
