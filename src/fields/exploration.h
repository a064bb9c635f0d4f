// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "fields/lattice_walk.h"

namespace pbrtmedia {

/// How learned bounds are explored before the first sample: the lattice in blocks of super-voxels, each with
/// `passes` times kLookupsPerPass look-ups (exploreBounds), whose extremes count for every super-voxel of the
/// block.
struct Exploration {
  static constexpr int kLookupsPerPass = 16;

  int passes = 0;               ///< 0: nothing is explored
  std::int64_t blockEdge = 1;   ///< super-voxels along each edge of a block: a power of 2
  Vec3<std::int64_t> blocks{};  ///< per axis; the last ones may be smaller

  std::size_t blockCount() const { return static_cast<std::size_t>(blocks.x * blocks.y * blocks.z); }
  /// In all.
  std::uint64_t lookups() const {
    return static_cast<std::uint64_t>(passes) * kLookupsPerPass * static_cast<std::uint64_t>(blockCount());
  }
};

/// The finest exploration of at most `mostLookups` in all and at most `mostPasses`: first passes are saved,
/// then blocks grow. No passes where not even one block may be explored once.
Exploration planExploration(const LatticeShape& shape, int mostPasses, std::uint64_t mostLookups);

}  // namespace pbrtmedia
