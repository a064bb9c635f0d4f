// SPDX-License-Identifier: BSD-2-Clause
#include "fields/super_voxels.h"

#include <algorithm>

#include "base/built_parts.h"
#include "base/interruption.h"
#include "base/parallel.h"

namespace pbrtmedia {
namespace {

/// Smallest and largest cell numbers that are not empty, per axis.
struct Occupancy {
  Vec3<std::int64_t> first, last;
  std::size_t empty = 0;
  bool any = false;
};

template <class Cells>
Occupancy occupancyOf(const LatticeShape& shape, const Cells& cells) {
  Occupancy o;
  for (std::int64_t k = 0; k < shape.count.z; ++k) {
    for (std::int64_t j = 0; j < shape.count.y; ++j) {
      for (std::int64_t i = 0; i < shape.count.x; ++i) {
        if (!(cells[static_cast<std::size_t>(shape.index(i, j, k))].upper > 0)) {
          ++o.empty;
          continue;
        }
        const Vec3<std::int64_t> at(i, j, k);
        o.first = o.any ? min(o.first, at) : at;
        o.last = o.any ? max(o.last, at) : at;
        o.any = true;
      }
    }
  }
  return o;
}

}  // namespace

SuperVoxels::SuperVoxels(const SuperVoxelLattice& lattice,
                         const std::function<SuperVoxel(std::int64_t, std::int64_t, std::int64_t)>& boundOf)
    : lattice_(lattice),
      inverseCellSize_(1 / lattice.cellSize.x, 1 / lattice.cellSize.y, 1 / lattice.cellSize.z) {
  countBuilt(Part::SuperVoxelGrids);
  const LatticeShape& shape = lattice.shape;
  bounds_.resize(static_cast<std::size_t>(shape.stored()), Bound{kApron, 0});
  means_.resize(bounds_.size());
  parallelFor(static_cast<std::size_t>(shape.count.y * shape.count.z), [&](std::size_t row) {
    const auto j = static_cast<std::int64_t>(row) % shape.count.y;
    const auto k = static_cast<std::int64_t>(row) / shape.count.y;
    const auto first = static_cast<std::size_t>(shape.index(0, j, k));
    leaveIfStopped();
    for (std::int64_t i = 0; i < shape.count.x; ++i) {
      const SuperVoxel cell = boundOf(i, j, k);
      bounds_[first + static_cast<std::size_t>(i)] = {cell.upper, cell.lower};
      means_[first + static_cast<std::size_t>(i)] = cell.mean;
    }
  });
  survey();
}

SuperVoxels::SuperVoxels(const SuperVoxelLattice& lattice, const SuperVoxel& bound)
    : SuperVoxels(lattice, [&](std::int64_t, std::int64_t, std::int64_t) { return bound; }) {}

void SuperVoxels::update(const std::function<SuperVoxel(std::size_t, const SuperVoxel&)>& newCell) {
  const LatticeShape& shape = lattice_.shape;
  for (std::int64_t k = 0; k < shape.count.z; ++k) {
    for (std::int64_t j = 0; j < shape.count.y; ++j) {
      for (std::int64_t i = 0; i < shape.count.x; ++i) {
        const auto index = static_cast<std::size_t>(shape.index(i, j, k));
        const SuperVoxel next = newCell(index, cell(index));
        bounds_[index] = {next.upper, next.lower};
        means_[index] = next.mean;
      }
    }
  }
  survey();
}

void SuperVoxels::survey() {
  maximum_ = 0;
  for (const Bound& bound : bounds_) maximum_ = std::max(maximum_, bound.upper);
  const Occupancy occupancy = occupancyOf(lattice_.shape, bounds_);
  emptyCells_ = occupancy.empty;
  occupied_ = {};
  if (!occupancy.any) return;
  occupied_.min = max(lattice_.box.min, scaled(Vec3d(occupancy.first), lattice_.cellSize));
  occupied_.max =
      min(lattice_.box.max, scaled(Vec3d(occupancy.last + Vec3<std::int64_t>(1, 1, 1)), lattice_.cellSize));
}

}  // namespace pbrtmedia
