// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/hash.h"
#include "base/rng.h"
#include "fields/exploration.h"
#include "fields/learned_bounds.h"

namespace pbrtmedia {

/// Proposes bounds for the blocks [first, last) of an exploration, x fastest, from look-ups in each: in
/// every pass at a random point of each octant, which finds where the density is large, and at as many points
/// around the largest found so far, ever closer, which climb. Answers how many look-ups that took.
/// `densityAt(local)`: the density at a point of the lattice's box. What is proposed depends on block and
/// seed alone. Thread-safe.
template <class Density>
std::uint64_t exploreBounds(const LearnedBounds& bounds, const Exploration& plan, std::size_t first,
                            std::size_t last, std::uint64_t seed, const Density& densityAt) {
  constexpr int kOctants = 8;
  static_assert(2 * kOctants == Exploration::kLookupsPerPass);
  // Shares of a block. A hill of any width from 0.05 to 0.4 of a block is climbed to 90 to 99 % by four
  // passes.
  constexpr double kFarthest = 1.0 / 4, kNearest = 1.0 / 64;
  const SuperVoxelLattice& lattice = bounds.inForce().lattice();
  std::uint64_t lookups = 0;
  if (plan.passes == 0) return lookups;
  for (std::size_t block = first; block < last; ++block) {
    const auto number = static_cast<std::int64_t>(block);
    const Vec3<std::int64_t> at{number % plan.blocks.x, number / plan.blocks.x % plan.blocks.y,
                                number / (plan.blocks.x * plan.blocks.y)};
    Vec3<std::int64_t> begin, end;  // super-voxels
    Vec3d low, high;
    for (std::size_t a = 0; a < 3; ++a) {
      begin[a] = at[a] * plan.blockEdge;
      end[a] = std::min(begin[a] + plan.blockEdge, lattice.shape.count[a]);
      low[a] = std::max(lattice.box.min[a], static_cast<double>(begin[a]) * lattice.cellSize[a]);
      high[a] = std::min(lattice.box.max[a], static_cast<double>(end[a]) * lattice.cellSize[a]);
    }
    const Vec3d size = high - low;
    Rng rng(hashCombine(seed, static_cast<std::uint64_t>(block)));
    Vec3d best = low + 0.5 * size;
    float most = -1, least = std::numeric_limits<float>::infinity();
    const auto look = [&](Vec3d p) {
      const float density = densityAt(p);
      ++lookups;
      least = std::min(least, density);
      if (!(density > most)) return;
      most = density;
      best = p;
    };
    const int looks = plan.passes * kOctants;
    for (int i = 0; i < looks; ++i) {
      const int octant = i % kOctants;
      const auto inside = [&](int bit) { return ((octant >> bit & 1) + rng.uniformDouble()) / 2; };
      const double x = inside(0), y = inside(1), z = inside(2);
      look(low + Vec3d(x * size.x, y * size.y, z * size.z));
    }
    for (int i = 0; i < looks; ++i) {
      const double reach = kFarthest * std::pow(kNearest / kFarthest, static_cast<double>(i) / looks);
      Vec3d p = best;
      for (std::size_t a = 0; a < 3; ++a) {
        p[a] = std::clamp(p[a] + (2 * rng.uniformDouble() - 1) * reach * size[a], low[a], high[a]);
      }
      look(p);
    }
    for (std::int64_t k = begin.z; k < end.z; ++k) {
      for (std::int64_t j = begin.y; j < end.y; ++j) {
        for (std::int64_t i = begin.x; i < end.x; ++i) {
          const auto cell = static_cast<std::size_t>(lattice.shape.index(i, j, k));
          bounds.propose(cell, most);
          bounds.propose(cell, least);
        }
      }
    }
  }
  return lookups;
}

}  // namespace pbrtmedia
