// SPDX-License-Identifier: BSD-2-Clause
#include "samplers/lattice.h"

#include <cmath>
#include <utility>

namespace pbrtmedia {

std::uint64_t latticeMinimumSquared(std::uint32_t points, std::uint32_t multiplier) {
  struct V {
    std::int64_t x, y;
    std::int64_t norm() const { return x * x + y * y; }
  };
  V a{1, multiplier}, b{0, points};
  if (a.norm() > b.norm()) std::swap(a, b);
  while (true) {  // a is the shorter one
    const double dot = static_cast<double>(a.x * b.x + a.y * b.y);
    const auto k = static_cast<std::int64_t>(std::nearbyint(dot / static_cast<double>(a.norm())));
    b = {b.x - k * a.x, b.y - k * a.y};
    if (b.norm() >= a.norm()) return static_cast<std::uint64_t>(a.norm());
    std::swap(a, b);
  }
}

std::uint32_t maxMinDistMultiplier(std::uint32_t points) {
  if (points < 4) return 1;
  std::uint32_t best = 1;
  std::uint64_t distance = 0;
  for (std::uint32_t m = 1; m <= points / 2; m += 2) {  // points - m is the mirror image
    const std::uint64_t d = latticeMinimumSquared(points, m);
    if (d > distance) {
      distance = d;
      best = m;
    }
  }
  return best;
}

}  // namespace pbrtmedia
