// SPDX-License-Identifier: BSD-2-Clause
#include "fields/canonical_line.h"

#include <cmath>
#include <limits>

namespace pbrtmedia {

CanonicalLine::CanonicalLine(const CanonicalFunction& function, const Setup& setup)
    : function_(&function),
      setup_(setup),
      toX_(setup.length > 0 ? function.width() / setup.length : 0),
      hasProvenBounds_(setup.control >= 1 && setup.lower <= 1 && setup.blind >= setup.superVoxels) {
  if (!(setup.length > 0)) return;
  const double width = function.width();
  const auto share = [&](unsigned i) { return static_cast<double>(i) / setup.superVoxels; };
  // A margin for positions that rounding carries over a border: relative to the line, and to its offset.
  const double margin =
      1e-12 * width + 4 * std::numeric_limits<double>::epsilon() * std::abs(setup.offset) * toX_;
  for (unsigned i = 0; i < setup.superVoxels; ++i) {
    const double a = share(i) * width, b = share(i + 1) * width;
    const CanonicalFunction::Range range =
        function.range(std::max(0.0, a - margin), std::min(width, b + margin));
    // Products as in density(), whose rounding keeps order.
    const double largest = setup.scale * range.max, smallest = setup.scale * range.min;
    DensityBounds<double> bound{std::max(setup.control * largest, setup.leastUpper), setup.lower * smallest};
    if (i == setup.blind) bound.upper = bound.lower = 0;
    if (setup.hasMeans) bound.mean = setup.scale * function.integral(a, b) / (b - a);
    const double sExit = i + 1 == setup.superVoxels ? setup.length : share(i + 1) * setup.length;
    const double sEnter = intervals_.empty() ? 0 : intervals_.back().sExit;
    if (sEnter < sExit) intervals_.push_back({sEnter, sExit, bound});
  }
}

double CanonicalLine::upperIntegral() const {
  double sum = 0;
  for (const Interval& i : intervals_) sum += (i.sExit - i.sEnter) * i.bound.upper;
  return sum;
}

}  // namespace pbrtmedia
