// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/vec.h"

namespace pbrtmedia {

/// Unit cells [0, count) per axis, numbered x fastest.
struct LatticeShape {
  std::array<std::int64_t, 3> count{1, 1, 1};
  std::int64_t cells() const { return count[0] * count[1] * count[2]; }
  std::int64_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return (z * count[1] + y) * count[0] + x;
  }
};

/// Visits the cells that the line o + t d, tMin <= t <= tMax, crosses, in order: visit(tExit, cellIndex)
/// returns false to stop; each cell begins where the one before ends, the last ends at tMax exactly.
///
/// The line must lie inside the lattice up to rounding: the caller has clipped it. Plane crossings are
/// computed from the plane's number, never summed up, so errors do not grow; a crossing that rounding puts
/// before the current t makes an interval of length 0, which is not visited. Every step moves one cell
/// forward, so there are at most count[0] + count[1] + count[2] of them, whatever the numbers.
template <class Visit>
void walkLattice(const LatticeShape& shape, Vec3d o, Vec3d d, double tMin, double tMax, Visit&& visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double inverse[3], next[3], plane[3];
  double step[3];
  std::int64_t stride[3], left[3];
  std::int64_t cell = 0, cellStride = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const double p = o[a] + tMin * d[a];
    const std::int64_t last = shape.count[a] - 1;
    // NaN and out-of-range positions fall on a valid cell.
    const std::int64_t i =
        p > 0 ? (p < static_cast<double>(last) ? static_cast<std::int64_t>(p) : last) : std::int64_t{0};
    const bool forward = d[a] > 0;
    cell += i * cellStride;
    stride[a] = forward ? cellStride : -cellStride;
    left[a] = forward ? last - i : i;  // planes that can still be crossed
    step[a] = forward ? 1.0 : -1.0;
    inverse[a] = 1 / d[a];
    plane[a] = static_cast<double>(forward ? i + 1 : i);
    next[a] = d[a] != 0 && left[a] > 0 ? (plane[a] - o[a]) * inverse[a] : kNever;
    cellStride *= shape.count[a];
  }
  double t = tMin;
  for (;;) {
    const std::size_t a = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const double exit = std::min(next[a], tMax);
    if (exit > t) {
      if (!visit(exit, static_cast<std::size_t>(cell))) return;
      t = exit;
    }
    if (!(next[a] < tMax)) return;
    cell += stride[a];
    plane[a] += step[a];
    next[a] = --left[a] > 0 ? (plane[a] - o[a]) * inverse[a] : kNever;
  }
}

}  // namespace pbrtmedia
