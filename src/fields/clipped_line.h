// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <limits>
#include <optional>

#include "base/segment.h"
#include "fields/affine_map.h"
#include "fields/lattice_walk.h"
#include "fields/super_voxels.h"

namespace pbrtmedia {

/// The part of a segment inside the occupied box of super-voxels, in the local space of a field and restarted
/// where it enters: s = t - tEntry(). So no number on it is larger than the field, however far away the
/// segment begins. Knows no density. Borrows the super-voxels.
class ClippedLine {
 public:
  /// Nothing when the segment meets no density: it misses the occupied box, has no length there, or is not
  /// finite in the field's space. So every point of a line can be looked up.
  static std::optional<ClippedLine> clip(const AffineMap& localFromWorld, const SuperVoxels& cells,
                                         const Segment& segment);

  const LocalLine& local() const { return line_; }  ///< from the entry; d in local units per t
  const SuperVoxels& cells() const { return *cells_; }
  double tEntry() const { return tEntry_; }
  double length() const { return length_; }
  Vec3d pointAt(double s) const { return line_.o + s * line_.d; }
  /// What lies between, restarted at sEnter; 0 <= sEnter < sExit <= length().
  ClippedLine stretch(double sEnter, double sExit) const {
    ClippedLine part(*cells_, {pointAt(sEnter), line_.d, line_.inverse}, sExit - sEnter, tEntry_ + sEnter);
    part.refinedColumn_ = refinedColumn_;
    return part;
  }

  /// Above this integral of a bound over a cell's stretch closer ones are wanted (FieldLine::walk).
  void refineAbove(double column) { refinedColumn_ = column; }
  bool isRefined() const { return refinedColumn_ < std::numeric_limits<double>::infinity(); }
  double refinedColumn() const { return refinedColumn_; }

  /// The super-voxels that the line crosses, as they are: DensityLine's `walk`.
  template <class Visit>
  void walkCells(Visit&& visit) const {
    cells_->walk(line_, length_, visit);
  }

 private:
  ClippedLine(const SuperVoxels& cells, const LocalLine& line, double length, double tEntry)
      : cells_(&cells), line_(line), length_(length), tEntry_(tEntry) {}

  const SuperVoxels* cells_;
  LocalLine line_;
  double length_, tEntry_;
  double refinedColumn_ = std::numeric_limits<double>::infinity();
};

}  // namespace pbrtmedia
