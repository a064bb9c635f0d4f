// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/ratio_tracking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/function_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::FunctionLine;
using test::kMaxAbsZ;
using test::runEstimator;
using test::RunningStats;
using test::simpson;
using test::zTest;

constexpr std::uint64_t kSeed = 20240607;

/// One canonical density on [0, 1] with piecewise constant bounds.
struct Case {
  std::string name;
  FunctionLine line;
};

std::vector<Case> cases() {
  const auto ramp = [](double s) { return 2 * s; };
  const auto wave = [](double s) { return 1 + std::sin(9 * s); };
  const auto spike = [](double s) { return .2 + 3 * std::exp(-400 * (s - .3) * (s - .3)); };
  return {
      {"constant, loose bound", {[](double) { return 1.0; }, {{1, {3, 0}}}}},
      {"ramp, tight bound", {ramp, {{1, {2, 0}}}}},
      {"ramp, bounds in four cells", {ramp, {{.25, {.5f, 0}}, {.5, {1, 0}}, {.75, {1.5f, 0}}, {1, {2, 0}}}}},
      {"wave, uneven cells", {wave, {{.1, {2, 0}}, {.7, {2.5f, 0}}, {1, {4, 0}}}}},
      {"spike", {spike, {{1, {3.2f, .2f}}}}},
      {"ramp, violated bound", {ramp, {{1, {1.2f, 0}}}}},
      {"step across an empty cell",
       {[](double s) { return s < .5 ? 0.0 : 2.0; }, {{.5, {0, 0}}, {1, {2.5f, 0}}}}},
  };
}

/// Integrals of f(s, bound(s)) cell by cell.
template <class F>
double integrate(const FunctionLine& line, F&& f) {
  double a = 0, sum = 0;
  for (const auto& i : line.intervals) {
    const double inside = 1e-12 * (i.sExit - a);  // steps at cell borders belong to their own side
    sum += simpson([&](double s) { return f(line.function(s), double{i.bound.upper}); }, a + inside,
                   i.sExit - inside);
    a = i.sExit;
  }
  return sum;
}

TEST(RatioTracking, HasTheMeanAndTheSecondMomentOfTheory) {
  for (const Case& c : cases()) {
    for (const double sigma : {.1, 1., 4.}) {
      const double tau = sigma * integrate(c.line, [](double mu, double) { return mu; });
      // E[T^2] = exp(-integral of bound + integral of (bound - mu)^2 / bound), for true bounds and false
      // ones.
      const double second = std::exp(sigma * integrate(c.line, [](double mu, double upper) {
                                       return upper > 0 ? -upper + (upper - mu) * (upper - mu) / upper : 0;
                                     }));
      Rng rng(kSeed);
      RunningStats mean, square;
      for (int n = 0; n < 200000; ++n) {
        const double t =
            runEstimator(RatioTracking{.rouletteThreshold = 0}, c.line, Channels<1>{sigma}, rng).value[0];
        mean.add(t);
        square.add(t * t);
      }
      const auto first = zTest(mean, std::exp(-tau), kSeed);
      EXPECT_LT(std::abs(first.z()), kMaxAbsZ) << c.name << ", sigma " << sigma << ": " << first;
      const auto moment = zTest(square, second, kSeed);
      EXPECT_LT(std::abs(moment.z()), kMaxAbsZ) << c.name << ", sigma " << sigma << ", squares: " << moment;
    }
  }
}

TEST(RatioTracking, StaysUnbiasedWithRoulette) {
  for (const Case& c : cases()) {
    for (const double threshold : {.1, .5, 1.}) {
      const double sigma = 3, tau = sigma * integrate(c.line, [](double mu, double) { return mu; });
      const auto test = test::runZTest(
          [&](Rng& rng) {
            return runEstimator(RatioTracking{threshold}, c.line, Channels<1>{sigma}, rng).value[0];
          },
          std::exp(-tau), kSeed, 200000);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << c.name << ", threshold " << threshold << ": " << test;
    }
  }
}

TEST(RatioTracking, AForgottenBoundIsNoticedByTheTest) {
  // Negative control: exp(-bound) in place of exp(-density) is rejected.
  const Case c = cases()[1];
  const auto test = test::runZTest(
      [&](Rng& rng) { return runEstimator(RatioTracking(), c.line, Channels<1>{1}, rng).value[0]; },
      std::exp(-2.0), kSeed, 200000);
  EXPECT_GT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST(RatioTracking, IsABernoulliTrialUnderATightBoundOverTheWholeLadder) {
  const FunctionLine line{[](double) { return 1.0; }, {{1, {1, 1}}}};
  for (const double tau : {1e-6, 1e-3, .1, 1., 5., 20., 50., 87., 88., 104., 1e3, 1e6}) {
    const double truth = std::exp(-tau), n = tau < 1e-4 ? 8e6 : 4e5;
    Rng rng(kSeed);
    double lost = 0;
    for (double i = 0; i < n; ++i) {
      const auto estimate = runEstimator(RatioTracking(), line, Channels<1>{tau}, rng);
      ASSERT_TRUE(estimate.value[0] == 0 || estimate.value[0] == 1);
      ASSERT_EQ(estimate.tally.lookups, estimate.value[0] == 0 ? 1u : 0u);
      lost += 1 - estimate.value[0];
    }
    const double z = (lost / n + std::expm1(-tau)) / std::sqrt(truth * -std::expm1(-tau) / n + 1e-300);
    EXPECT_LT(std::abs(z), kMaxAbsZ) << "tau " << tau << ", lost " << lost << " of " << n;
  }
}

TEST(RatioTracking, ReturnsExactlyOneInVacuumWithoutALookup) {
  FunctionLine vacuum{[](double) { return 0.0; }, {{1, {0, 0}}}};
  Rng rng(1);
  // Only the probe of the unproven zero.
  EXPECT_EQ(runEstimator(RatioTracking(), vacuum, Channels<1>{5}, rng).value[0], 1.0);
  EXPECT_EQ(runEstimator(RatioTracking(), vacuum, Channels<1>{5}, rng).tally.lookups, 1u);
  const auto clear = runEstimator(RatioTracking(), cases()[1].line, Channels<3>{0, 0, 0}, rng);
  EXPECT_EQ(clear.value, filled<3>(1));
  EXPECT_EQ(clear.tally.lookups, 0u);
}

TEST(RatioTracking, SpendsTheOpticalDepthOfItsBound) {
  const FunctionLine line{[](double) { return .5; }, {{.5, {2, 0}}, {1, {6, 0}}}};
  const auto test = test::runZTest(
      [&](Rng& rng) {
        return runEstimator(RatioTracking{.rouletteThreshold = 0}, line, Channels<1>{1}, rng).tally.lookups;
      },
      4.0, kSeed, 100000);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST(RatioTracking, CountsViolatedBoundsAndStaysFinite) {
  const FunctionLine line{[](double) { return 3.0; }, {{1, {1, 0}}}};
  Rng rng(kSeed);
  RunningStats values;
  RenderCounters counters;
  for (int n = 0; n < 200000; ++n) {
    const auto estimate = runEstimator(RatioTracking(), line, Channels<1>{.5}, rng);
    ASSERT_TRUE(std::isfinite(estimate.value[0]));
    values.add(estimate.value[0]);
    estimate.tally.addTo(counters);
  }
  EXPECT_EQ(counters.boundViolations, counters.densityLookups);
  EXPECT_GT(counters.boundViolations, 0u);
  EXPECT_EQ(counters.worstBoundRatio, 3.0);
  const auto test = zTest(values, std::exp(-1.5), kSeed);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST(RatioTracking, CountsDensityUnderABoundOfZeroAndEnds) {
  const FunctionLine line{[](double) { return 3.0; }, {{.5, {0, 0}}, {1, {0, 0}}}};
  Rng rng(1);
  const auto estimate = runEstimator(RatioTracking(), line, Channels<1>{1}, rng);
  EXPECT_TRUE(std::isfinite(estimate.value[0]));
  EXPECT_EQ(estimate.tally.violations, 2u);
  EXPECT_EQ(estimate.tally.worstRatio, std::numeric_limits<double>::infinity());
}

TEST(RatioTracking, IsExactPerChannelInAChromaticMedium) {
  const Channels<3> sigma{0, 1, 10};
  for (const Case& c : cases()) {
    if (c.name.find("violated") != std::string::npos) continue;  // heavy tails for channel 2
    const double column = integrate(c.line, [](double mu, double) { return mu; });
    Rng rng(kSeed);
    RunningStats values[3];
    for (int n = 0; n < 100000; ++n) {
      const auto estimate = runEstimator(RatioTracking(), c.line, sigma, rng);
      for (std::size_t i = 0; i < 3; ++i) values[i].add(estimate.value[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto test = zTest(values[i], std::exp(-sigma[i] * column), kSeed);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << c.name << ", channel " << i << ": " << test;
    }
  }
}

TEST(RatioTracking, EndsWhereADensityIsItsBound) {
  // For one float x in ten or so, x * (1 / x) rounds to something else than 1.
  std::size_t awkward = 0;
  for (float bound = 0.013f; bound < 50; bound *= 1.29f) {
    const double x = double{bound};
    awkward += x * (1 / x) != 1 ? 1 : 0;
    const FunctionLine line{[x](double) { return x; }, {{1, {bound, 0}}}};
    Rng rng(kSeed);
    SampleStream stream(rng);
    for (int n = 0; n < 50; ++n) {
      const Estimate<1> estimate = RatioTracking()(line, Channels<1>{20 / x}, stream);
      EXPECT_LE(estimate.tally.lookups, 1u);
      EXPECT_EQ(estimate.value[0], estimate.tally.lookups == 0 ? 1 : 0);
    }
  }
  EXPECT_GT(awkward, 0u) << "else nothing was tested";
}

}  // namespace
}  // namespace pbrtmedia
