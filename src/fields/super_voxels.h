// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "base/vec.h"
#include "fields/lattice_walk.h"
#include "fields/super_voxel.h"

namespace pbrtmedia {

/// Super-voxels per axis that somebody asks for, 0: one for the whole axis. Nothing: the field chooses.
using WantedCells = std::optional<std::array<int, 3>>;

/// How the local space of a field is cut into super-voxels: cell (i, j, k) begins at (i, j, k) times the
/// size.
struct SuperVoxelLattice {
  LatticeShape shape{};
  Vec3d cellSize{1, 1, 1};  ///< local units
  Bounds3d box{};           ///< where the field lives, inside the lattice (local units)

  std::size_t cellCount() const {
    return static_cast<std::size_t>(shape.count.x * shape.count.y * shape.count.z);
  }
};

/// Cells of whole gaps between samples: how many gaps along one axis, so that there are at most `wanted`
/// (WantedCells) over `gaps` of them.
constexpr std::int64_t gapsPerCell(std::int64_t gaps, int wanted) {
  return wanted < 1 ? gaps : (gaps + wanted - 1) / wanted;
}

/// A coarse grid of bounds over the local space of a field: cell (i, j, k) covers [i, i + 1] x ... times
/// the size of a cell in local units. Walking is thread-safe and makes no virtual call.
class SuperVoxels {
 public:
  /// `boundOf(i, j, k)` is called once per cell, in parallel, and must bound the density over the closed
  /// cell.
  SuperVoxels(const SuperVoxelLattice& lattice,
              const std::function<SuperVoxel(std::int64_t, std::int64_t, std::int64_t)>& boundOf);
  /// The same for every cell.
  SuperVoxels(const SuperVoxelLattice& lattice, const SuperVoxel& bound);

  const LatticeShape& shape() const { return lattice_.shape; }
  const SuperVoxelLattice& lattice() const { return lattice_; }
  Vec3d cellSize() const { return lattice_.cellSize; }
  SuperVoxel at(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return cell(static_cast<std::size_t>(shape().index(i, j, k)));
  }
  std::size_t cellCount() const { return lattice_.cellCount(); }
  /// Box around the cells that are not empty, cut to the field's box, in local units. Empty when all are.
  const Bounds3d& occupied() const { return occupied_; }
  /// Stored cells, apron included: what `cellAt` and `update` count.
  std::size_t storedCells() const { return bounds_.size(); }
  /// The stored cell that holds a local point of the box; the nearest one for a point outside.
  std::size_t cellAt(Vec3d local) const {
    const auto along = [](double x, std::int64_t count) {
      return static_cast<std::int64_t>(std::clamp(x, 0.0, static_cast<double>(count) - 0.5));
    };
    const Vec3d at = scaled(local, inverseCellSize_);
    const Vec3<std::int64_t>& n = shape().count;
    return static_cast<std::size_t>(shape().index(along(at.x, n.x), along(at.y, n.y), along(at.z, n.z)));
  }
  float upperOf(std::size_t storedCell) const { return bounds_[storedCell].upper; }
  float lowerOf(std::size_t storedCell) const { return bounds_[storedCell].lower; }
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
    const LocalLine inCells{scaled(line.o, inverseCellSize_), scaled(line.d, inverseCellSize_),
                            scaled(line.inverse, lattice_.cellSize)};
    double entered = 0;  // where the empty stretch at hand begins
    double reached = 0;  // up to where the line is known
    bool stopped = false;
    std::size_t last = 0;  // the occupied cell that was visited last
    walkLattice(lattice_.shape, inCells, 0.0, length, [&](double sExit, std::size_t index) {
      const SuperVoxel bound = cell(index);
      if (bound.upper > 0) {
        if (entered < reached && !visit(entered, reached, kEmpty)) return !(stopped = true);
        if (!visit(reached, sExit, bound)) return !(stopped = true);
        entered = sExit;
        last = index;
      } else if (bound.upper < 0 && entered == reached && reached > 0) {
        // Rounding has left a sliver behind the last face: it belongs to the cell before.
        if (!visit(reached, sExit, cell(last))) return !(stopped = true);
        entered = sExit;
      }
      reached = sExit;
      return true;
    });
    if (!stopped && entered < reached) visit(entered, reached, kEmpty);
  }

 private:
  static constexpr SuperVoxel kEmpty{0, 0, 0};
  static constexpr float kApron = -1;  ///< marks cells outside the lattice
  struct Bound {
    float upper = 0, lower = 0;
  };
  /// A caller that does not use the mean does not load it: walks are inlined.
  SuperVoxel cell(std::size_t index) const {
    const Bound bound = bounds_[index];
    return {bound.upper, bound.lower, means_[index]};
  }

  static Vec3d scaled(Vec3d a, Vec3d b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  /// Maximum, empty cells and the occupied box from the cells.
  void survey();

  SuperVoxelLattice lattice_;
  Vec3d inverseCellSize_;
  Bounds3d occupied_;
  float maximum_ = 0;
  std::size_t emptyCells_ = 0;
  std::vector<Bound> bounds_;  ///< with an apron of cells marked kApron
  std::vector<float> means_;   ///< apart, so that walks that ask for bounds only read less
};

}  // namespace pbrtmedia
