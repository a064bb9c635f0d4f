// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/pink_p_cumulative.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fields/canonical_line.h"
#include "support/contract_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimators/p_series_cumulative.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::runEstimator;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20241122;

TEST(PinkPCumulative, IsPSeriesCumulativeWithoutCorrelation) {
  const auto function = *findCanonicalFunction("cosine");
  const CanonicalLine line(function, {.control = 1.3, .superVoxels = 4});
  Rng a(kSeed), b(kSeed);
  for (int i = 0; i < 500; ++i) {
    const double sigma = .1 * i;
    const auto pink = runEstimator(PinkPCumulative{.law = {0}}, line, Channels<1>{sigma}, a);
    const auto exponential = runEstimator(PSeriesCumulative{}, line, Channels<1>{sigma}, b);
    EXPECT_NEAR(pink.value[0], exponential.value[0], 1e-11 * (1 + std::abs(exponential.value[0])));
    EXPECT_EQ(pink.tally.lookups, exponential.tally.lookups);
  }
}

TEST(PinkPCumulative, LooksOnceInConstantMediaUnderATightBound) {
  const auto function = *findCanonicalFunction("constant");
  const CanonicalLine line(function, {});
  Rng rng(kSeed);
  for (const double c : {0., .5, 1., 3.}) {
    for (const double sigma : {1e-8, 1., 100., 1e6}) {
      const auto estimate = runEstimator(PinkPCumulative{.law = {c}}, line, Channels<1>{sigma}, rng);
      EXPECT_NEAR(estimate.value[0], PinkNoiseLaw{c}(sigma), 1e-13);
      EXPECT_EQ(estimate.tally.lookups, 1u);
    }
  }
}

TEST(PinkPCumulative, HasTheMeanOfTheLawUnderLooseAndLowControls) {
  for (const char* name : {"cosine", "gaussian", "hole", "linear-up"}) {
    const auto function = *findCanonicalFunction(name);
    for (const double control : {.7, 1., 3.}) {
      const CanonicalLine line(function, {.control = control, .superVoxels = 4});
      for (const double c : {.5, .8, 1.5}) {
        for (const double sigma : {.3, 2.}) {
          const PinkPCumulative estimator{.law = {c}};
          const auto test = test::runZTest(
              [&](Rng& rng) { return runEstimator(estimator, line, Channels<1>{sigma}, rng).value[0]; },
              PinkNoiseLaw{c}(sigma * line.integral()), kSeed, 10000);
          EXPECT_LT(std::abs(test.z()), kMaxAbsZ)
              << name << ", control " << control << ", C " << c << ", sigma " << sigma << ": " << test;
        }
      }
    }
  }
}

TEST(PinkPCumulative, HasTheVarianceOfTheReferenceOnTheSine) {
  // Experiments of Misso et al. 2022: C = 0.8, T = 0.5, bound twice the mean: mse 0.0784 at 1.614 look-ups.
  const auto function = *findCanonicalFunction("sine");
  const CanonicalLine line(function, {});
  const PinkNoiseLaw law{.8};
  const double sigma = (std::pow(.5, -.64) - 1) / .64;
  RunningStats value, square, cost;
  Rng rng(kSeed);
  for (int i = 0; i < 200000; ++i) {
    const auto estimate = runEstimator(PinkPCumulative{.law = law}, line, Channels<1>{sigma}, rng);
    value.add(estimate.value[0]);
    square.add((estimate.value[0] - .5) * (estimate.value[0] - .5));
    cost.add(static_cast<double>(estimate.tally.lookups));
  }
  EXPECT_LT(std::abs(zTest(value, .5).z()), kMaxAbsZ) << zTest(value, .5, kSeed);
  EXPECT_NEAR(square.mean(), .0784, kMaxAbsZ * square.standardError() + 5e-5);  // its last digit
  EXPECT_NEAR(cost.mean(), 1.614, kMaxAbsZ * cost.standardError() + 5e-4);
}

TEST(PinkPCumulative, EndsUnderControlsBeyondItsRange) {
  const auto function = *findCanonicalFunction("constant");
  const CanonicalLine line(function, {.control = 1e-3});
  Rng rng(kSeed);
  std::uint64_t capped = 0;
  for (const double sigma : {1., 100., 1e4}) {
    for (int i = 0; i < 20; ++i) {
      const auto estimate = runEstimator(PinkPCumulative{.law = {1}}, line, Channels<1>{sigma}, rng);
      EXPECT_FALSE(std::isnan(estimate.value[0]));
      EXPECT_LT(estimate.tally.lookups, 100000u);
      EXPECT_GT(estimate.tally.violations, 0u);
      capped += estimate.tally.capped;
    }
  }
  EXPECT_GT(capped, 0u);
}

TEST(PinkPCumulative, CutsAConvergentSeriesNowhere) {
  // In the emptiest medium a bound can hold, with the longest series.
  const auto function = *findCanonicalFunction("spike");
  const CanonicalLine line(function, {});
  Rng rng(kSeed);
  for (const double c : {.1, .5, 1., 5.}) {
    for (const double sigma : {.01, 1., 100.}) {
      for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(runEstimator(PinkPCumulative{.law = {c}}, line, Channels<1>{sigma}, rng).tally.capped, 0u);
      }
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
