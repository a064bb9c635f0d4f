// SPDX-License-Identifier: BSD-2-Clause
#include "fields/canonical_line.h"

#include <cmath>
#include <limits>

namespace pbrtmedia {

CanonicalLine::CanonicalLine(const CanonicalFunction& function, const Setup& setup)
    : function_(&function),
      setup_(setup),
      toX_(setup.length > 0 ? function.width() / setup.length : 0),
      length_(std::min(setup.length, setup.end)),
      hasProvenBounds_(setup.control >= 1 && setup.lower <= 1 && setup.blind >= setup.superVoxels &&
                       setup.lowerDensity <= setup.scale * function.range().min) {
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
    if (setup.lowerDensity > 0) bound.lower = std::min(setup.lowerDensity, bound.upper);
    if (i == setup.blind) bound.upper = bound.lower = 0;
    const double cut = std::min(b, setup.end * toX_);
    if (setup.hasMeans && a < cut) bound.mean = setup.scale * function.integral(a, cut) / (cut - a);
    const double sExit =
        std::min(i + 1 == setup.superVoxels ? setup.length : share(i + 1) * setup.length, length());
    const double sEnter = intervals_.empty() ? 0 : intervals_.back().sExit;
    if (sEnter < sExit) intervals_.push_back({sEnter, sExit, bound});
  }
}

CanonicalLine::CanonicalLine(const CanonicalLine& whole, double length, double begin)
    : function_(whole.function_),
      setup_(whole.setup_),
      toX_(whole.toX_),
      length_(length),
      begin_(begin),
      hasProvenBounds_(whole.hasProvenBounds_),
      record_(whole.record_),
      clamps_(whole.clamps_) {}

CanonicalLine CanonicalLine::stretch(double sEnter, double sExit) const {
  CanonicalLine part(*this, sExit - sEnter, begin_ + sEnter);
  for (std::size_t i = intervalAt(sEnter); i < intervals_.size() && intervals_[i].sEnter < sExit; ++i) {
    const Interval& whole = intervals_[i];
    const double enter = std::max(whole.sEnter - sEnter, 0.0);
    const double exit = whole.sExit < sExit ? whole.sExit - sEnter : part.length_;
    if (enter < exit) part.intervals_.push_back({enter, exit, whole.bound});
  }
  return part;
}

void CanonicalLine::setUppers(std::span<const double> uppers, bool clamps) {
  for (std::size_t i = 0; i < intervals_.size(); ++i) {
    DensityBounds<double>& bound = intervals_[i].bound;
    bound.upper = uppers[i];
    bound.lower = std::min(bound.lower, bound.upper);
  }
  hasProvenBounds_ = false;
  clamps_ = clamps;
}

std::size_t CanonicalLine::intervalAt(double s) const {
  const auto after = std::upper_bound(intervals_.begin(), intervals_.end(), s,
                                      [](double value, const Interval& i) { return value < i.sEnter; });
  return after == intervals_.begin() ? 0 : static_cast<std::size_t>(after - intervals_.begin()) - 1;
}

double CanonicalLine::upperIntegral() const {
  double sum = 0;
  for (const Interval& i : intervals_) sum += (i.sExit - i.sEnter) * i.bound.upper;
  return sum;
}

}  // namespace pbrtmedia
