// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <limits>

namespace pbrtmedia {

/// The depth at which a falling law g, g(0) = 1, comes down to `u` in (0, 1]; infinite where it never does.
/// By bisection to the last bit but one or two: some 100 evaluations of g.
template <class Law>
double invertFalling(const Law& law, double u) {
  if (!(u < 1)) return 0;
  if (law(std::numeric_limits<double>::infinity()) >= u) return std::numeric_limits<double>::infinity();
  double lo = 0, hi = 1;
  while (law(hi) > u) {
    lo = hi;
    hi *= 2;
    if (std::isinf(hi)) return hi;
  }
  for (;;) {
    const double middle = lo + (hi - lo) / 2;
    if (!(middle > lo && middle < hi)) return middle;
    (law(middle) > u ? lo : hi) = middle;
  }
}

}  // namespace pbrtmedia
