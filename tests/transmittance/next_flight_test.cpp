// SPDX-License-Identifier: BSD-2-Clause
// The estimators that add up along one walk: next-flight and unidirectional MIS.
#include "transmittance/estimators/next_flight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "transmittance/estimators/unidirectional_mis.h"
#include "transmittance/series_cases.h"
#include "transmittance/series_moments.h"

namespace pbrtmedia {
namespace {

using test::ControlledFunction;
using test::kMaxAbsZ;
using test::runEstimator;
using test::secondMoment;

constexpr std::uint64_t kSeed = 20241201;

template <class Estimator>
class WalkedSum : public testing::Test {};
using WalkedSums = testing::Types<NextFlight, UnidirectionalMis>;
TYPED_TEST_SUITE(WalkedSum, WalkedSums);

TYPED_TEST(WalkedSum, HasTheMeanTheVarianceAndTheCostOfTheory) {
  for (const auto& c : {ControlledFunction("cosine", 1, 1), ControlledFunction("linear-up", 2.3, 1.5),
                        ControlledFunction("gaussian", .5, 1), ControlledFunction("step", 1, .8),
                        ControlledFunction("hole", .1, .1), ControlledFunction("linear-down", 2, 1, 7)}) {
    const double truth = std::exp(-c.tau()), variance = secondMoment(TypeParam{}, c) - truth * truth;
    const auto run = test::runMany(TypeParam{}, c.line(), c.sigma(), truth, 60000, kSeed);
    EXPECT_LT(std::abs(test::zOfMean(run.value, truth, variance, c.tau())), kMaxAbsZ)
        << c.what() << ": " << test::zTest(run.value, truth);
    const auto spread = test::zTest(run.squares, variance, kSeed);
    EXPECT_LT(std::abs(spread.z()), kMaxAbsZ) << c.what() << ", variance: " << spread;
    const auto cost = test::zTest(run.lookups, c.depth(), kSeed);
    EXPECT_LT(std::abs(cost.z()), kMaxAbsZ) << c.what() << ", look-ups: " << cost;
  }
}

TYPED_TEST(WalkedSum, KnowsTheVarianceOfTheOtherWalkIsNotItsOwn) {
  // Negative control: the formula of the one is rejected by the other.
  const ControlledFunction c("cosine", 1, 1);
  const double truth = std::exp(-c.tau());
  const double other = (std::is_same_v<TypeParam, NextFlight> ? secondMoment(UnidirectionalMis{}, c)
                                                              : secondMoment(NextFlight{}, c)) -
                       truth * truth;
  const auto run = test::runMany(TypeParam{}, c.line(), c.sigma(), truth, 60000, kSeed);
  EXPECT_GT(std::abs(test::zTest(run.squares, other, kSeed).z()), kMaxAbsZ);
}

TYPED_TEST(WalkedSum, IsExactUnderTheTightestBoundOfAConstant) {
  for (const double tau : {1e-8, .1, 3., 700.}) {
    const ControlledFunction c("constant", tau, 1);
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
      const auto estimate = runEstimator(TypeParam{}, c.line(), Channels<1>{tau}, rng);
      ASSERT_LE(estimate.tally.lookups, 1u);
      if constexpr (std::is_same_v<TypeParam, NextFlight>) {
        ASSERT_NEAR(estimate.value[0], std::exp(-tau), 1e-12 * std::exp(-tau));
      } else {
        // h from the start, and once more if nothing was met.
        const double h = 1 / (1 + std::exp(tau));
        ASSERT_NEAR(estimate.value[0], h * (estimate.tally.lookups == 0 ? 2 : 1), 1e-12 * h);
      }
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
