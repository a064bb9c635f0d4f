// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/hash.h"
#include "base/rng.h"
#include "fields/super_voxels.h"

namespace pbrtmedia {

/// A stand-in for a density whose bounds tell little of it (given, or not learned yet), to steer sampling:
/// `upper` and `mean` of each cell are the average over a point in each of its octants. So that nothing is
/// missed for good, they are at least `kLeastShare` of the average over all cells, and 1 where every point
/// found nothing. `densityAt(local)`: the density at a point of the lattice's box; called in parallel, 8
/// times for each cell.
template <class Density>
SuperVoxels probedDensity(const SuperVoxelLattice& lattice, const Density& densityAt) {
  constexpr float kLeastShare = 0.1f;
  constexpr int kOctants = 8;
  const auto& n = lattice.shape.count;
  SuperVoxels cells(lattice, [&](std::int64_t i, std::int64_t j, std::int64_t k) -> SuperVoxel {
    Rng rng(mix64(static_cast<std::uint64_t>((k * n.y + j) * n.x + i)));
    double sum = 0;
    for (int octant = 0; octant < kOctants; ++octant) {
      const auto along = [&](std::int64_t cell, int bit, std::size_t axis) {
        const double inside = ((octant >> bit & 1) + rng.uniformDouble()) / 2;
        const double x = (static_cast<double>(cell) + inside) * lattice.cellSize[axis];
        return std::clamp(x, lattice.box.min[axis], lattice.box.max[axis]);
      };
      const double x = along(i, 0, 0), y = along(j, 1, 1), z = along(k, 2, 2);
      sum += static_cast<double>(densityAt(Vec3d(x, y, z)));
    }
    const auto mean = static_cast<float>(sum / kOctants);
    return {mean, 0, mean};
  });
  double sum = 0;
  for (std::int64_t k = 0; k < n.z; ++k) {
    for (std::int64_t j = 0; j < n.y; ++j) {
      for (std::int64_t i = 0; i < n.x; ++i) sum += static_cast<double>(cells.at(i, j, k).mean);
    }
  }
  const auto average = static_cast<float>(sum / static_cast<double>(lattice.cellCount()));
  const float least = average > 0 ? kLeastShare * average : 1.0f;
  cells.update([&](std::size_t, const SuperVoxel& cell) -> SuperVoxel {
    const float density = std::max(cell.mean, least);
    return {density, 0, density};
  });
  return cells;
}

}  // namespace pbrtmedia
