// SPDX-License-Identifier: BSD-2-Clause
#include "fields/canonical_line.h"

namespace pbrtmedia {

CanonicalLine::CanonicalLine(const CanonicalFunction& function, const Setup& setup)
    : function_(&function), setup_(setup), toX_(setup.length > 0 ? function.width() / setup.length : 0) {
  if (!(setup.length > 0)) return;
  const double width = function.width();
  const auto share = [&](unsigned i) { return static_cast<double>(i) / setup.superVoxels; };
  // Rounding to float keeps order, so a bound of the function rounds to a bound of the rounded density.
  const auto density = [&](double value) { return static_cast<float>(setup.scale * value); };
  for (unsigned i = 0; i < setup.superVoxels; ++i) {
    // A relative margin, for positions that rounding carries over a border.
    const double margin = 1e-12 * width;
    const double a = share(i) * width, b = share(i + 1) * width;
    const CanonicalFunction::Range range =
        function.range(std::max(0.0, a - margin), std::min(width, b + margin));
    SuperVoxel bound{std::max(density(setup.control * range.max), static_cast<float>(setup.leastUpper)),
                     density(setup.lower * range.min)};
    if (i == setup.blind) bound.upper = bound.lower = 0;
    if (setup.hasMeans) bound.mean = density(function.integral(a, b) / (b - a));
    const double sExit = i + 1 == setup.superVoxels ? setup.length : share(i + 1) * setup.length;
    const double sEnter = intervals_.empty() ? 0 : intervals_.back().sExit;
    if (sEnter < sExit) intervals_.push_back({sEnter, sExit, bound});
  }
}

double CanonicalLine::upperIntegral() const {
  double sum = 0;
  for (const Interval& i : intervals_) sum += (i.sExit - i.sEnter) * static_cast<double>(i.bound.upper);
  return sum;
}

double CanonicalLine::lowerIntegral() const {
  double sum = 0;
  for (const Interval& i : intervals_) sum += (i.sExit - i.sEnter) * static_cast<double>(i.bound.lower);
  return sum;
}

}  // namespace pbrtmedia
