// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
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
/// `cellSize` local units. Walking is thread-safe and makes no virtual call.
class SuperVoxels {
 public:
  /// `boundOf(i, j, k)` is called once per cell, in parallel, and must bound the density over the closed
  /// cell. `box`: where the field lives, inside the lattice (local units).
  SuperVoxels(const LatticeShape& shape, double cellSize, const Bounds3d& box,
              const std::function<SuperVoxel(std::int64_t, std::int64_t, std::int64_t)>& boundOf);

  const LatticeShape& shape() const { return shape_; }
  const Bounds3d& box() const { return box_; }
  double cellSize() const { return cellSize_; }
  SuperVoxel at(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return cell(static_cast<std::size_t>(shape_.index(i, j, k)));
  }
  std::size_t cellCount() const {
    return static_cast<std::size_t>(shape_.count.x * shape_.count.y * shape_.count.z);
  }
  /// Box around the cells that are not empty, cut to the field's box, in local units. Empty when all are.
  const Bounds3d& occupied() const { return occupied_; }
  /// Stored cells, apron included: what `cellAt` and `update` count.
  std::size_t storedCells() const { return bounds_.size(); }
  /// The stored cell that holds a local point of the box; the nearest one for a point outside.
  std::size_t cellAt(Vec3d local) const {
    const auto along = [&](double x, std::int64_t count) {
      return static_cast<std::int64_t>(
          std::clamp(x * inverseCellSize_, 0.0, static_cast<double>(count) - 0.5));
    };
    return static_cast<std::size_t>(shape_.index(
        along(local.x, shape_.count.x), along(local.y, shape_.count.y), along(local.z, shape_.count.z)));
  }
  float upperOf(std::size_t storedCell) const { return bounds_[storedCell].upper; }
  /// Replaces every cell by newCell(storedCell, old), x fastest. Not while others walk.
  void update(const std::function<SuperVoxel(std::size_t, const SuperVoxel&)>& newCell);

  /// Largest bound of all cells.
  float maximum() const { return maximum_; }
  std::size_t emptyCells() const { return emptyCells_; }
  std::size_t bytes() const { return bounds_.size() * sizeof(Bound) + means_.size() * sizeof(float); }

  /// Calls visit(sEnter, sExit, bound) for the intervals of the line (local units), 0 <= s <= length, in
  /// order and without gaps, until visit answers false. Neighbouring empty cells come as one interval, of
  /// mean 0. The caller has clipped the line to `occupied()` or to the field's box.
  template <class Visit>
  void walk(const LocalLine& line, double length, Visit&& visit) const {
    const double scale = inverseCellSize_;
    const LocalLine inCells{line.o * scale, line.d * scale, line.inverse * cellSize_};
    double entered = 0;  // where the empty stretch at hand begins
    double reached = 0;  // up to where the line is known
    bool stopped = false;
    walkLattice(shape_, inCells, 0.0, length, [&](double sExit, std::size_t index) {
      const SuperVoxel bound = cell(index);
      if (bound.upper > 0) {
        if (entered < reached && !visit(entered, reached, kEmpty)) return !(stopped = true);
        if (!visit(reached, sExit, bound)) return !(stopped = true);
        entered = sExit;
      }
      reached = sExit;
      return true;
    });
    if (!stopped && entered < reached) visit(entered, reached, kEmpty);
  }

 private:
  static constexpr SuperVoxel kEmpty{0, 0, 0};
  struct Bound {
    float upper = 0, lower = 0;
  };
  /// A caller that does not use the mean does not load it: walks are inlined.
  SuperVoxel cell(std::size_t index) const {
    const Bound bound = bounds_[index];
    return {bound.upper, bound.lower, means_[index]};
  }

  /// Maximum, empty cells and the occupied box from the cells.
  void survey();

  LatticeShape shape_;
  double cellSize_, inverseCellSize_;
  Bounds3d box_, occupied_;
  float maximum_ = 0;
  std::size_t emptyCells_ = 0;
  std::vector<Bound> bounds_;  ///< with an apron of empty cells
  std::vector<float> means_;   ///< apart, so that walks that ask for bounds only read less
};

}  // namespace pbrtmedia
