// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/statistics.h"

namespace pbrtmedia {

/// One number per channel: 1 for grey media, 3 for chromatic ones, which share their density look-ups.
template <std::size_t N>
using Channels = std::array<double, N>;

template <std::size_t N>
constexpr Channels<N> filled(double value) {
  Channels<N> c{};
  c.fill(value);
  return c;
}
template <std::size_t N>
constexpr double maxOf(const Channels<N>& c) {
  return *std::max_element(c.begin(), c.end());
}

/// What one segment cost, and what it revealed about its bounds. Kept in registers while tracking and added
/// to the render's counters once.
struct LookupTally {
  std::uint64_t lookups = 0;         ///< density look-ups spent: the cost axis of every plot
  std::uint64_t nullCollisions = 0;  ///< tentative collisions that were null
  std::uint64_t violations = 0;      ///< look-ups that found a density above its bound
  std::uint64_t capped = 0;          ///< estimates that a limit on look-ups cut short
  double worstRatio = 0;             ///< largest density / bound among them; infinite for a bound of 0
  double worstS = 0, worstDensity = 0, worstBound = 0;  ///< where on the line that was, and both numbers

  void noteViolation(double s, double density, double bound) {
    ++violations;
    const double ratio = bound > 0 ? density / bound : std::numeric_limits<double>::infinity();
    if (violations > 1 && !(ratio > worstRatio)) return;
    worstRatio = ratio;
    worstS = s;
    worstDensity = density;
    worstBound = bound;
  }
  void addTo(RenderCounters& counters) const {
    counters.densityLookups += lookups;
    counters.nullCollisions += nullCollisions;
    counters.boundViolations += violations;
    counters.cappedEstimates += capped;
    counters.worstBoundRatio = std::max(counters.worstBoundRatio, worstRatio);
  }
};

/// An estimate of exp(-integral of sigma_t rho) over a segment, per channel.
template <std::size_t N>
struct Estimate {
  Channels<N> value =
      filled<N>(1);  ///< dimensionless; may leave [0, 1] where bounds are violated: do not clamp
  LookupTally tally;
};

}  // namespace pbrtmedia
