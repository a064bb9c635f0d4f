// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/vec.h"

namespace pbrtmedia {

/// Unit cells [0, count) per axis, stored x fastest inside an apron of one cell all around, so that a step
/// across the last face still finds a cell.
struct LatticeShape {
  Vec3<std::int64_t> count{1, 1, 1};

  std::int64_t row() const { return count.x + 2; }                 ///< cells from one y to the next
  std::int64_t slice() const { return row() * (count.y + 2); }     ///< cells from one z to the next
  std::int64_t stored() const { return slice() * (count.z + 2); }  ///< apron included
  std::int64_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return (z + 1) * slice() + (y + 1) * row() + x + 1;
  }
};

/// A line o + s d with the reciprocal of its direction: infinite where d is 0 or too small to invert.
struct LocalLine {
  Vec3d o, d, inverse;
};

/// Visits the cells that the line crosses on sMin <= s <= sMax, in order: visit(sExit, storedIndex) returns
/// false to stop; each cell begins where the one before ends, the last ends at sMax exactly.
///
/// The line must be finite and lie inside the lattice up to rounding: the caller has clipped it. After
/// Amanatides & Woo 1987, "A Fast Voxel Traversal Algorithm", but all axes whose plane comes first step
/// together, so edges and corners cross no cell of length 0. A line that starts on a plane which it leaves
/// backward begins with an interval of length 0, which is not visited. Crossings accumulate one rounding per
/// step, at most 1e-12 of the length after ten thousand; one that strays past the last face is caught by the
/// apron. Every step moves forward, so there are at most count.x + count.y + count.z + 3 of them.
template <class Visit>
void walkLattice(const LatticeShape& shape, const LocalLine& line, double sMin, double sMax, Visit&& visit) {
  struct Axis {
    double next, delta;
    std::int64_t cell, stride;
  };
  const auto enter = [&](double o, double d, double inverse, std::int64_t count, std::int64_t stride) {
    const double last = static_cast<double>(count - 1);
    const auto cell = static_cast<std::int64_t>(std::min(std::max(o + sMin * d, 0.0), last));
    const bool forward = d > 0, moves = std::abs(inverse) < std::numeric_limits<double>::infinity();
    const double plane = static_cast<double>(cell) + (forward ? 1.0 : 0.0);
    return Axis{moves ? (plane - o) * inverse : std::numeric_limits<double>::infinity(), std::abs(inverse),
                cell, forward ? stride : -stride};
  };
  const auto [o, d, inverse] = line;
  Axis x = enter(o.x, d.x, inverse.x, shape.count.x, 1);
  Axis y = enter(o.y, d.y, inverse.y, shape.count.y, shape.row());
  Axis z = enter(o.z, d.z, inverse.z, shape.count.z, shape.slice());
  std::int64_t cell = shape.index(x.cell, y.cell, z.cell);
  double s = sMin;
  for (;;) {
    const double exit = std::min(x.next, std::min(y.next, z.next));
    if (!(exit < sMax)) break;
    if (exit > s) {
      if (!visit(exit, static_cast<std::size_t>(cell))) return;
      s = exit;
    }
    const auto step = [&](Axis& axis) {
      const bool here = axis.next <= exit;
      axis.next += here ? axis.delta : 0.0;
      cell += here ? axis.stride : 0;
    };
    step(x);
    step(y);
    step(z);
  }
  if (s < sMax) visit(sMax, static_cast<std::size_t>(cell));
}

}  // namespace pbrtmedia
