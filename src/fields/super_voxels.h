// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "base/vec.h"
#include "fields/lattice_walk.h"
#include "fields/super_voxel.h"

namespace pbrtmedia {

/// A coarse grid of bounds over the local space of a field: cell (i, j, k) covers [i, i + 1] x ... times
/// `cellSize` local units. Immutable; walking is thread-safe and makes no virtual call.
class SuperVoxels {
 public:
  /// `boundOf(i, j, k)` is called once per cell, in parallel, and must bound the density over the closed
  /// cell. `box`: where the field lives, inside the lattice (local units).
  SuperVoxels(const LatticeShape& shape, double cellSize, const Bounds3d& box,
              const std::function<SuperVoxel(std::int64_t, std::int64_t, std::int64_t)>& boundOf);

  const LatticeShape& shape() const { return shape_; }
  double cellSize() const { return cellSize_; }
  const SuperVoxel& at(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return cells_[static_cast<std::size_t>(shape_.index(i, j, k))];
  }
  std::size_t cellCount() const {
    return static_cast<std::size_t>(shape_.count.x * shape_.count.y * shape_.count.z);
  }
  /// Box around the cells that are not empty, cut to the field's box, in local units. Empty when all are.
  const Bounds3d& occupied() const { return occupied_; }
  /// Largest bound of all cells.
  float maximum() const { return maximum_; }
  std::size_t emptyCells() const { return emptyCells_; }
  std::size_t bytes() const { return cells_.size() * sizeof(SuperVoxel); }

  /// Calls visit(sEnter, sExit, bound) for the intervals of the line (local units), 0 <= s <= length, in
  /// order and without gaps, until visit answers false. Neighbouring empty cells come as one interval. The
  /// caller has clipped the line to `occupied()` or to the field's box.
  template <class Visit>
  void walk(const LocalLine& line, double length, Visit&& visit) const {
    const double scale = inverseCellSize_;
    const LocalLine inCells{line.o * scale, line.d * scale, line.inverse * cellSize_};
    double entered = 0;  // where the empty stretch at hand begins
    double reached = 0;  // up to where the line is known
    bool stopped = false;
    walkLattice(shape_, inCells, 0.0, length, [&](double sExit, std::size_t cell) {
      const SuperVoxel bound = cells_[cell];
      if (bound.upper > 0) {
        if (entered < reached && !visit(entered, reached, SuperVoxel{})) return !(stopped = true);
        if (!visit(reached, sExit, bound)) return !(stopped = true);
        entered = sExit;
      }
      reached = sExit;
      return true;
    });
    if (!stopped && entered < reached) visit(entered, reached, SuperVoxel{});
  }

 private:
  LatticeShape shape_;
  double cellSize_, inverseCellSize_;
  Bounds3d occupied_;
  float maximum_ = 0;
  std::size_t emptyCells_ = 0;
  std::vector<SuperVoxel> cells_;  ///< with an apron of empty ones
};

}  // namespace pbrtmedia
