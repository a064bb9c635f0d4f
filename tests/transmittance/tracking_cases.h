// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "support/function_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"

namespace pbrtmedia::test {

/// A FunctionLine whose bounds count as proven: no probes, so the cost is that of theory.
struct ProvenLine : FunctionLine {
  static constexpr bool hasProvenBounds() { return true; }
};

/// A density on [0, 1] with integral 1.
struct Shape {
  std::string name;
  std::function<double(double)> f;
  double max;        ///< supremum
  double jump = -1;  ///< where it jumps; nowhere: -1
};

inline std::vector<Shape> shapes() {
  const double cosineIntegral = 1 + (std::sin(20.8) - std::sin(.8)) / 20;
  const auto bump = [](double x) { return std::exp(-(x - .32) * (x - .32) / (2 * .05 * .05)); };
  const double root = std::sqrt(2 * .05 * .05),
               area = .05 * std::sqrt(std::acos(-1.) / 2) * (std::erf(.68 / root) + std::erf(.32 / root));
  constexpr double kHigh = .92 / .6;
  return {
      {"constant", [](double) { return 1.0; }, 1},
      {"cosine", [=](double x) { return (1 + std::cos(20 * x + .8)) / cosineIntegral; }, 2 / cosineIntegral},
      {"gaussian", [=](double x) { return bump(x) / area; }, 1 / area},
      {"hole", [=](double x) { return (1 - bump(x)) / (1 - area); }, 1 / (1 - area)},
      {"rising", [](double x) { return 2 * x; }, 2},
      {"falling", [](double x) { return 2 * (1 - x); }, 2},
      {"step", [](double x) { return x < .4 ? .2 : kHigh; }, kHigh, .4},
  };
}
inline Shape shape(const std::string& name) {
  for (const Shape& s : shapes()) {
    if (s.name == name) return s;
  }
  throw std::invalid_argument("no such shape");
}

/// A shape, the extinction that makes its integral tau, and bounds.
struct TrackingCase {
  std::string name;
  Shape shape;
  double tau;
  ProvenLine line;

  /// Integral of f(mu, majorant, minorant) exp(-integral from 0 to x of g(mu, majorant, minorant)), all
  /// extinctions, mu rounded to float as the line does. Midpoint rule on each smooth stretch.
  template <class F, class G>
  double integrateAttenuated(F&& f, G&& g) const {
    double sum = 0, depth = 0, a = 0;
    for (const auto& interval : line.intervals) {
      const double upper = tau * double{interval.bound.upper}, lower = tau * double{interval.bound.lower};
      std::vector<double> ends{interval.sExit};
      if (shape.jump > a && shape.jump < interval.sExit) ends.insert(ends.begin(), shape.jump);
      for (const double b : ends) {
        constexpr int kSteps = 4000;
        const double h = (b - a) / kSteps;
        for (int i = 0; i < kSteps; ++i) {
          const double mu = tau * double{line.density(a + (i + .5) * h)};
          const double kill = h * g(mu, upper, lower);
          // The mean of exp(-kill x) over a step.
          sum += h * f(mu, upper, lower) * std::exp(-depth) * (kill > 0 ? -std::expm1(-kill) / kill : 1);
          depth += kill;
        }
        a = b;
      }
    }
    return sum;
  }
  template <class F>
  double integrate(F&& f) const {
    return integrateAttenuated(f, [](double, double, double) { return 0.; });
  }
};

/// Bounds of `intervals` equal cells: the upper ones `control` times the local maximum, the lower ones
/// `minorantShare` times the local minimum.
inline TrackingCase trackingCase(const Shape& shape, double tau, double control, int intervals = 1,
                                 double minorantShare = 0) {
  TrackingCase c{shape.name, shape, tau, {{shape.f, {}}}};
  c.name += ", tau " + std::to_string(tau) + ", control " + std::to_string(control) + ", cells " +
            std::to_string(intervals) + ", minorant " + std::to_string(minorantShare);
  for (int i = 0; i < intervals; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    constexpr int kProbes = 5000;
    for (int j = 0; j <= kProbes; ++j) {
      const double density = double{c.line.density((i + static_cast<double>(j) / kProbes) / intervals)};
      low = std::min(low, density);
      high = std::max(high, density);
    }
    // Between the probes a smooth shape exceeds them by less than this share.
    if (intervals > 1 && high > low) high *= 1 + 1e-4, low *= 1 - 1e-2;
    if (intervals == 1) high = shape.max;
    c.line.intervals.push_back(
        {(i + 1.) / intervals,
         {static_cast<float>(control * high), static_cast<float>(minorantShare * low)}});
  }
  return c;
}

/// Every shape, thickness and bounding control; also in seven cells of their own.
inline std::vector<TrackingCase> boundedCases(double minorantShare = 0) {
  std::vector<TrackingCase> all;
  for (const Shape& s : shapes()) {
    for (const double tau : {.05, .5, 2.3, 6.}) {
      for (const double control : {1., 1.5, 5.})
        all.push_back(trackingCase(s, tau, control, 1, minorantShare));
      all.push_back(trackingCase(s, tau, 1.2, 7, minorantShare));
    }
  }
  return all;
}
/// Controls that do not bound.
inline std::vector<TrackingCase> lowControlCases(double minorantShare = 0) {
  std::vector<TrackingCase> all;
  for (const Shape& s : shapes()) {
    for (const double tau : {.05, .5, 2.3}) {
      for (const double control : {.6, .9}) all.push_back(trackingCase(s, tau, control, 1, minorantShare));
      all.push_back(trackingCase(s, tau, .8, 7, minorantShare));
    }
  }
  return all;
}

/// What many estimates told.
struct Moments {
  RunningStats value, square, lookups;
  std::uint64_t seed;
  std::uint64_t violations = 0;
};
template <class Estimator, class Line>
Moments measure(const Estimator& estimator, const Line& line, double sigma, int n, std::uint64_t seed) {
  Moments m{{}, {}, {}, seed};
  Rng rng(seed);
  for (int i = 0; i < n; ++i) {
    const auto estimate = runEstimator(estimator, line, Channels<1>{sigma}, rng);
    m.value.add(estimate.value[0]);
    m.square.add(estimate.value[0] * estimate.value[0]);
    m.lookups.add(static_cast<double>(estimate.tally.lookups));
    m.violations += estimate.tally.violations;
  }
  return m;
}
inline void expectMean(const RunningStats& values, double truth, std::uint64_t seed,
                       const std::string& what) {
  const ZTest test = zTest(values, truth, seed);
  // Densities are rounded to float.
  if (std::abs(test.mean - truth) < 1e-6 * std::abs(truth)) return;
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << what << ": " << test;
}
/// The estimates' moments, in theory.
struct MomentsInTheory {
  double mean, second, fourth;
};
/// The mean of the estimates and of their squares, against the standard errors of theory: rare large values,
/// which a sample may have missed, then do not make it too sure of itself. The mean of the look-ups.
inline void expectMoments(const Moments& m, const MomentsInTheory& truth, double cost,
                          const std::string& what) {
  const double n = static_cast<double>(m.value.count());
  const auto expect = [&](const RunningStats& found, double mean, double meanOfSquares, const char* name) {
    const double variance = std::max(meanOfSquares - mean * mean, 0.);
    const ZTest test{found.mean(), mean, std::sqrt(variance / n), 0, m.seed, m.value.count()};
    if (std::abs(test.mean - mean) < 1e-6 * std::abs(mean)) return;  // densities are rounded to float
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << what << ", " << name << ": " << test;
  };
  expect(m.value, truth.mean, truth.second, "mean");
  expect(m.square, truth.second, truth.fourth, "squares");
  expectMean(m.lookups, cost, m.seed, what + ", look-ups");
}

/// Whether two sets of values come from one distribution, atoms allowed: chi-square over the values met by
/// both together.
inline ChiSquareTest twoSampleTest(std::vector<double> a, std::vector<double> b, std::size_t bins = 40) {
  std::vector<double> all(a);
  all.insert(all.end(), b.begin(), b.end());
  std::sort(all.begin(), all.end());
  std::vector<double> edges;
  for (std::size_t i = 1; i < bins; ++i) edges.push_back(all[i * all.size() / bins]);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const std::size_t used = 2 * edges.size() + 1;  // an atom on an edge is a bin of its own
  std::vector<double> inA(used, 0), inB(used, 0);
  const auto count = [&](const std::vector<double>& values, std::vector<double>& bin) {
    for (const double v : values) {
      const auto at = std::lower_bound(edges.begin(), edges.end(), v);
      const auto i = static_cast<std::size_t>(at - edges.begin());
      ++bin[at != edges.end() && *at == v ? 2 * i + 1 : 2 * i];
    }
  };
  count(a, inA);
  count(b, inB);
  // Homogeneity: (b - n a / m)^2 has the expectation of the pooled count times a factor.
  const double shareA = static_cast<double>(a.size()) / static_cast<double>(all.size());
  ChiSquareTest test;
  for (std::size_t i = 0; i < used; ++i) {
    const double pooled = inA[i] + inB[i];
    test.observedTotal += inA[i];
    test.expectedTotal += pooled * shareA;
    if (pooled < 20) continue;  // rare bins carry no weight
    const double d = inA[i] - pooled * shareA;
    test.statistic += d * d / (pooled * shareA * (1 - shareA));
    ++test.degreesOfFreedom;
  }
  if (test.degreesOfFreedom > 1) --test.degreesOfFreedom;
  return test;
}

}  // namespace pbrtmedia::test
