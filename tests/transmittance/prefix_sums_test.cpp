// SPDX-License-Identifier: BSD-2-Clause
// What all prefix-sum estimators have in common, beyond the contract of every estimator.
#include <gtest/gtest.h>

#include <cmath>

#include "support/function_line.h"
#include "transmittance/estimators/bidirectional_mis.h"
#include "transmittance/estimators/next_flight.h"
#include "transmittance/estimators/p_series_cmf.h"
#include "transmittance/estimators/p_series_cumulative.h"
#include "transmittance/estimators/p_series_next_flight.h"
#include "transmittance/estimators/unidirectional_mis.h"
#include "transmittance/series_cases.h"

namespace pbrtmedia {
namespace {

using test::ControlledFunction;
using test::kMaxAbsZ;
using test::runEstimator;

constexpr std::uint64_t kSeed = 20241202;

template <class Estimator>
class PrefixSum : public testing::Test {};
using PrefixSums = testing::Types<NextFlight, UnidirectionalMis, BidirectionalMis, PSeriesNextFlight,
                                  PSeriesCumulative, PSeriesCmf>;
TYPED_TEST_SUITE(PrefixSum, PrefixSums);

TYPED_TEST(PrefixSum, DoesNotFeelHowTheLineIsCut) {
  const ControlledFunction c("cosine", 2, 1.5);
  const CanonicalLine whole = c.line();
  const test::CutLine cut{whole, 100};
  Rng a(kSeed), b(kSeed);
  for (int i = 0; i < 1000; ++i) {
    const auto x = runEstimator(TypeParam{}, whole, Channels<1>{2}, a);
    const auto y = runEstimator(TypeParam{}, cut, Channels<1>{2}, b);
    ASSERT_NEAR(x.value[0], y.value[0], 1e-6);  // densities are rounded to float
    ASSERT_EQ(x.tally.lookups, y.tally.lookups);
  }
}

TYPED_TEST(PrefixSum, EndsAtItsLookupLimitAndSaysSo) {
  const ControlledFunction c("cosine", 6, 2);
  Rng rng(kSeed);
  std::uint64_t capped = 0;
  TypeParam estimator;
  estimator.maxLookups = 3;
  for (int i = 0; i < 500; ++i) {
    const auto estimate = runEstimator(estimator, c.line(), Channels<1>{6}, rng);
    ASSERT_LE(estimate.tally.lookups, 3u);
    ASSERT_TRUE(std::isfinite(estimate.value[0]));
    capped += estimate.tally.capped;
  }
  EXPECT_GT(capped, 490u);
  EXPECT_EQ(estimator.traits().bias, EstimatorTraits::Bias::Consistent);
  EXPECT_FALSE(estimator.traits().biasNote.empty());
  EXPECT_TRUE(estimator.traits().boundedCost);
  EXPECT_FALSE(TypeParam{}.traits().boundedCost);
  EXPECT_TRUE(TypeParam{}.traits().biasNote.empty());
}

TYPED_TEST(PrefixSum, SurvivesThicknessBeyondDoubleUnderAnyControl) {
  for (const double sigma : {800., 1e4, 1e5}) {
    for (const double control : {.1, .6, 1., 3.}) {
      const ControlledFunction c("cosine", sigma, control);
      Rng rng(kSeed);
      const auto estimate = runEstimator(TypeParam{}, c.line(), Channels<1>{sigma}, rng);
      EXPECT_FALSE(std::isnan(estimate.value[0])) << c.what();
      if (control >= 1) {
        EXPECT_LT(std::abs(estimate.value[0]), 1e-30) << c.what();
      }
    }
  }
}

TYPED_TEST(PrefixSum, IsOneWhereTheExtinctionIsTheSmallestDouble) {
  const ControlledFunction c("cosine", 1, 2);
  Rng rng(kSeed);
  const auto estimate = runEstimator(TypeParam{}, c.line(), Channels<3>{1e-300, 0, 1e-320}, rng);
  for (const double t : estimate.value) EXPECT_NEAR(t, 1, 1e-15);
}

TYPED_TEST(PrefixSum, CountsDensityUnderABoundOfZeroAndEnds) {
  const test::FunctionLine line{[](double) { return 3.0; }, {{.5, {0, 0}}, {1, {0, 0}}}};
  Rng rng(1);
  const auto estimate = runEstimator(TypeParam{}, line, Channels<1>{1}, rng);
  EXPECT_EQ(estimate.value[0], 1);
  EXPECT_EQ(estimate.tally.violations, 2u);
  EXPECT_EQ(estimate.tally.worstRatio, std::numeric_limits<double>::infinity());
}

TYPED_TEST(PrefixSum, CountsViolatedBounds) {
  const test::FunctionLine line{[](double) { return 3.0; }, {{1, {1, 0}}}};
  Rng rng(kSeed);
  std::uint64_t lookups = 0, violations = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto estimate = runEstimator(TypeParam{}, line, Channels<1>{.5}, rng);
    lookups += estimate.tally.lookups;
    violations += estimate.tally.violations;
  }
  EXPECT_GT(lookups, 0u);
  EXPECT_EQ(violations, lookups);
}

TYPED_TEST(PrefixSum, HasTheMeanOfEveryChannelOverEmptyAndUnevenIntervals) {
  const test::FunctionLine line{[](double s) { return s < .4 ? 0 : 2 + std::sin(8 * s); },
                                {{.3, {0, 0}}, {.5, {2, 0}}, {.55, {1.5f, 0}}, {.9, {3, 0}}, {1, {4, 0}}}};
  const double column = test::simpson([](double s) { return 2 + std::sin(8 * s); }, .4, 1);
  const Channels<3> sigma{1.5, 0, .4};
  Rng rng(kSeed);
  test::RunningStats values[3];
  for (int i = 0; i < 60000; ++i) {
    const auto estimate = runEstimator(TypeParam{}, line, sigma, rng);
    for (std::size_t c = 0; c < 3; ++c) values[c].add(estimate.value[c]);
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const auto test = test::zTest(values[c], std::exp(-sigma[c] * column), kSeed);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "channel " << c << ": " << test;
  }
  // Negative control: 3 % of the extinction can be told.
  EXPECT_GT(std::abs(test::zTest(values[0], std::exp(-.97 * sigma[0] * column), kSeed).z()), kMaxAbsZ);
}

}  // namespace
}  // namespace pbrtmedia
