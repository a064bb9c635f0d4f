// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fields/canonical_function.h"
#include "fields/canonical_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"

// Lines and runs that the tests of prefix-sum estimators share.
namespace pbrtmedia::test {

/// One canonical function under a control of `control` times its maximum. Keeps the function alive.
class ControlledFunction {
 public:
  ControlledFunction(std::string_view name, double sigma, double control, unsigned superVoxels = 1)
      : function_(*findCanonicalFunction(name)),
        setup_{.control = control, .superVoxels = superVoxels},
        sigma_(sigma),
        what_(name) {
    what_ += ", sigma " + std::to_string(sigma) + ", control " + std::to_string(control) + " x maximum, " +
             std::to_string(superVoxels) + " super-voxels";
  }
  CanonicalLine line() const { return {function_, setup_}; }
  double sigma() const { return sigma_; }
  double tau() const { return sigma_ * line().integral(); }
  double depth() const { return sigma_ * line().upperIntegral(); }
  const std::string& what() const { return what_; }
  /// Largest value of the function at sigma 1.
  double maximum() const { return function_.range().max; }

 private:
  CanonicalFunction function_;
  CanonicalLine::Setup setup_;
  double sigma_;
  std::string what_;
};

/// A line whose walk comes in `pieces` intervals of the one bound of the whole.
struct CutLine {
  static constexpr bool hasProvenBounds() { return true; }
  const CanonicalLine& whole;
  int pieces;

  double length() const { return whole.length(); }
  double density(double s) const { return whole.density(s); }
  void densities(std::span<const double> s, std::span<double> out) const { whole.densities(s, out); }
  template <class Visit>
  void walk(Visit&& visit) const {
    for (int i = 0; i < pieces; ++i) {
      const auto border = [&](int n) { return n == pieces ? length() : length() * n / pieces; };
      if (!visit(border(i), border(i + 1), whole.intervals().front().bound)) return;
    }
  }
};

/// The functions that every estimator is measured on.
inline constexpr std::string_view kCanonical[] = {"constant",  "cosine",      "gaussian", "hole",
                                                  "linear-up", "linear-down", "step"};

/// What n estimates were like.
struct Run {
  RunningStats value, lookups;
  RunningStats squares;  ///< of (value - truth)^2: its mean estimates the variance
};

template <class Estimator, class Line>
Run runMany(const Estimator& estimator, const Line& line, double sigma, double truth, std::uint64_t n,
            std::uint64_t seed) {
  Run run;
  Rng rng(seed);
  for (std::uint64_t i = 0; i < n; ++i) {
    const auto estimate = runEstimator(estimator, line, Channels<1>{sigma}, rng);
    run.value.add(estimate.value[0]);
    run.lookups.add(static_cast<double>(estimate.tally.lookups));
    run.squares.add((estimate.value[0] - truth) * (estimate.value[0] - truth));
  }
  return run;
}

/// Mean against truth in standard errors taken from the exact variance, and the rounding of densities to
/// float.
inline double zOfMean(const RunningStats& values, double truth, double variance, double tau) {
  const double rounding = (tau + 1) * truth * 0x1p-23;
  const double spread = std::sqrt(std::max(variance, 0.0) / static_cast<double>(values.count()));
  return (values.mean() - truth) / (spread + rounding);
}

inline constexpr double kMostBudgets = 30;

/// The mean on every canonical function for optical depths from thin to thick, and controls from too low to
/// loose. `secondMoment(case)` is exact, or 0 to take the variance from the sample. Each case spends some
/// `budget` look-ups, more where the estimates have heavy tails; what would take more than kMostBudgets is
/// left out, and the number of those is the answer.
template <class Estimator, class SecondMoment>
int expectMeans(const Estimator& estimator, SecondMoment&& secondMoment, double budget, std::uint64_t seed) {
  int leftOut = 0;
  for (const std::string_view name : kCanonical) {
    for (const double sigma : {.05, .5, 2.3, 6.}) {
      for (const double control : {1., 1.5, 5., .6, .9}) {
        const ControlledFunction c(name, sigma, control);
        const double truth = std::exp(-c.tau()), second = secondMoment(c);
        const double variance = second - truth * truth, cost = 1 + c.depth();
        const double wanted = std::max(budget / cost, second > 0 ? 200 * variance / (truth * truth) : 0.0);
        if (wanted * cost > kMostBudgets * budget) {
          ++leftOut;
          continue;
        }
        const Run run = runMany(estimator, c.line(), sigma, truth, static_cast<std::uint64_t>(wanted), seed);
        const double used = second > 0 ? variance : run.value.variance();
        EXPECT_LT(std::abs(zOfMean(run.value, truth, used, c.tau())), kMaxAbsZ)
            << c.what() << ": " << zTest(run.value, truth, seed) << ", exact variance " << variance;
      }
    }
  }
  return leftOut;
}

}  // namespace pbrtmedia::test
