// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fields/density_line.h"

namespace pbrtmedia::test {

/// A one-dimensional density with bounds of our choice (true or not), for estimators and samplers.
struct FunctionLine {
  static constexpr bool hasProvenBounds() { return false; }
  struct Interval {
    double sExit;
    SuperVoxel bound;
  };

  std::function<double(double)> function;
  std::vector<Interval> intervals;  ///< in order; the first begins at 0

  double length() const { return intervals.empty() ? 0.0 : intervals.back().sExit; }
  float density(double s) const { return static_cast<float>(function(s)); }
  void densities(std::span<const double> s, std::span<float> out) const { densitiesOneByOne(*this, s, out); }
  template <class Visit>
  void walk(Visit&& visit) const {
    double sEnter = 0;
    for (const Interval& i : intervals) {
      if (!visit(sEnter, i.sExit, i.bound)) return;
      sEnter = i.sExit;
    }
  }
};

/// Integral of f over [a, b] by Simpson's rule with 2n intervals.
template <class F>
double simpson(F&& f, double a, double b, int n = 20000) {
  const double h = (b - a) / (2 * n);
  double sum = f(a) + f(b);
  for (int i = 1; i < 2 * n; ++i) sum += (i & 1 ? 4 : 2) * f(a + i * h);
  return sum * h / 3;
}

}  // namespace pbrtmedia::test
