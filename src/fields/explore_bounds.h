// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/hash.h"
#include "base/rng.h"
#include "fields/learned_bounds.h"

namespace pbrtmedia {

/// Proposes bounds for the cells [firstCell, lastCell) of a lattice, x fastest, from look-ups in each: in
/// every pass at a random point of each octant, which finds where the density is large, and at as many points
/// around the largest found so far, ever closer, which climb. Answers how many look-ups that took.
/// `densityAt(local)`: the density at a point of the lattice's box. What is proposed depends on cell and seed
/// alone. Thread-safe.
template <class Density>
std::uint64_t exploreBounds(const LearnedBounds& bounds, std::size_t firstCell, std::size_t lastCell,
                            std::uint64_t seed, const Density& densityAt) {
  constexpr int kOctants = 8;
  // Shares of a cell. A hill of any width from 0.05 to 0.4 of a cell is climbed to 90 to 99 % by four passes.
  constexpr double kFarthest = 1.0 / 4, kNearest = 1.0 / 64;
  const SuperVoxelLattice& lattice = bounds.inForce().lattice();
  const Vec3<std::int64_t>& n = lattice.shape.count;
  std::uint64_t lookups = 0;
  for (std::size_t cell = firstCell; cell < lastCell; ++cell) {
    const auto number = static_cast<std::int64_t>(cell);
    const Vec3<std::int64_t> at{number % n.x, number / n.x % n.y, number / (n.x * n.y)};
    const auto stored = static_cast<std::size_t>(lattice.shape.index(at.x, at.y, at.z));
    Vec3d low, high;
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::max(lattice.box.min[a], static_cast<double>(at[a]) * lattice.cellSize[a]);
      high[a] = std::min(lattice.box.max[a], static_cast<double>(at[a] + 1) * lattice.cellSize[a]);
    }
    const Vec3d size = high - low;
    Rng rng(hashCombine(seed, static_cast<std::uint64_t>(cell)));
    Vec3d best = low + 0.5 * size;
    float most = -1;
    const auto look = [&](Vec3d p) {
      const float density = densityAt(p);
      ++lookups;
      bounds.propose(stored, density);
      if (!(density > most)) return;
      most = density;
      best = p;
    };
    const int passes = bounds.params().warmUpPasses;
    for (int i = 0; i < passes * kOctants; ++i) {
      const int octant = i % kOctants;
      const auto inside = [&](int bit) { return ((octant >> bit & 1) + rng.uniformDouble()) / 2; };
      const double x = inside(0), y = inside(1), z = inside(2);
      look(low + Vec3d(x * size.x, y * size.y, z * size.z));
    }
    for (int i = 0; i < passes * kOctants; ++i) {
      const double reach =
          kFarthest * std::pow(kNearest / kFarthest, static_cast<double>(i) / (passes * kOctants));
      Vec3d p = best;
      for (std::size_t a = 0; a < 3; ++a) {
        p[a] = std::clamp(p[a] + (2 * rng.uniformDouble() - 1) * reach * size[a], low[a], high[a]);
      }
      look(p);
    }
  }
  return lookups;
}

}  // namespace pbrtmedia
