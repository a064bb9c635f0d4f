// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace pbrtmedia {

/// Squared length, in units of 1/points^2, of the shortest vector between two points of the rank-1 lattice
/// (j, multiplier * j mod points) / points on the torus: Lagrange reduction of its basis. points >= 2.
std::uint64_t latticeMinimumSquared(std::uint32_t points, std::uint32_t multiplier);

/// The odd multiplier below points for which that distance is largest, the smallest such; `points` a power of
/// two up to 2^16 (odd: then both coordinates take every multiple of 1/points once).
std::uint32_t maxMinDistMultiplier(std::uint32_t points);

}  // namespace pbrtmedia
