// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/track_length.h"

#include <gtest/gtest.h>

#include "tracking_cases.h"
#include "transmittance/estimators/johnson.h"

namespace pbrtmedia {
namespace {

using namespace test;

constexpr std::uint64_t kSeed = 20261101;

TEST(TrackLength, IsABernoulliTrialOverTheWholeLadder) {
  for (const double tau : {1e-8, 1e-3, .1, 1., 5., 50., 750., 1e6}) {
    for (const double control : {1., 1.5, 40.}) {
      const TrackingCase c = trackingCase(shape("constant"), tau, control);
      const int n = tau * control > 5 ? 2000 : 50000;
      Rng rng(kSeed);
      double lost = 0;
      for (int i = 0; i < n; ++i) {
        const auto estimate = runEstimator(TrackLength(), c.line, Channels<1>{tau}, rng);
        ASSERT_TRUE(estimate.value[0] == 0 || estimate.value[0] == 1);
        ASSERT_GE(estimate.tally.lookups, estimate.tally.nullCollisions);
        ASSERT_EQ(estimate.tally.lookups - estimate.tally.nullCollisions, estimate.value[0] == 0 ? 1u : 0u);
        lost += 1 - estimate.value[0];
      }
      const double p = -std::expm1(-tau), z = (lost - n * p) / std::sqrt(n * p * (1 - p) + 1);
      EXPECT_LT(std::abs(z), kMaxAbsZ) << "tau " << tau << ", control " << control << ": " << lost;
    }
  }
}

TEST(TrackLength, CountsViolationsAndIsBiasedByThemAsItSays) {
  const TrackingCase c = trackingCase(shape("rising"), 1, .5);
  const Moments m = measure(TrackLength(), c.line, 1, 20000, kSeed);
  EXPECT_GT(m.violations, 0u);
  EXPECT_EQ(TrackLength().traits().control, EstimatorTraits::Control::Bounding);
  // Negative control of every test of means here: what a bound cut off was not absorbed.
  EXPECT_GT(zTest(m.value, std::exp(-1.), kSeed).z(), kMaxAbsZ);
  // All above the bound counts as the bound: 1/4 + 1/2 is left of the optical depth of 1.
  expectMean(m.value, std::exp(-.75), kSeed, "clamped");
}

TEST(TrackLength, EndsAtItsLimitAndSaysSo) {
  const TrackingCase c = trackingCase(shape("constant"), 1, 1000);
  Rng rng(kSeed);
  const auto estimate = runEstimator(TrackLength{.maxLookups = 7}, c.line, Channels<1>{1}, rng);
  EXPECT_LE(estimate.tally.lookups, 7u);
  EXPECT_EQ(estimate.tally.capped, 1u);
  EXPECT_TRUE(TrackLength{.maxLookups = 7}.traits().boundedCost);
  EXPECT_EQ(TrackLength{.maxLookups = 7}.traits().bias, EstimatorTraits::Bias::Consistent);
}

TEST(TrackLength, IsABernoulliTrialInEachChannel) {
  const Channels<3> sigma{0, .7, 4};
  for (const Shape& s : shapes()) {
    const TrackingCase c = trackingCase(s, 1, 1.5, 3);
    Rng rng(kSeed);
    RunningStats value[3];
    for (int i = 0; i < 20000; ++i) {
      const auto estimate = runEstimator(TrackLength(), c.line, sigma, rng);
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_TRUE(estimate.value[k] == 0 || estimate.value[k] == 1);
        value[k].add(estimate.value[k]);
      }
      // One number decides for all: the thicker channel never outlives the thinner.
      ASSERT_GE(estimate.value[1], estimate.value[2]);
    }
    for (std::size_t k = 0; k < 3; ++k) expectMean(value[k], std::exp(-sigma[k]), kSeed, c.name);
  }
}

TEST(TrackLength, ProbesEmptyStretchesOfUnprovenBoundsOnly) {
  const FunctionLine unproven{[](double) { return 3.0; }, {{.5, {0, 0}}, {1, {0, 0}}}};
  Rng rng(kSeed);
  const auto probed = runEstimator(TrackLength(), unproven, Channels<1>{1}, rng);
  EXPECT_EQ(probed.value[0], 1);
  EXPECT_EQ(probed.tally.violations, 2u);
  EXPECT_EQ(probed.tally.worstRatio, std::numeric_limits<double>::infinity());
  EXPECT_EQ(runEstimator(TrackLength(), ProvenLine{unproven}, Channels<1>{1}, rng).tally.lookups, 0u);
}

TEST(Johnson, OfOneWalkIsTrackLength) {
  for (const Shape& s : shapes()) {
    const TrackingCase c = trackingCase(s, 2, 1.5);
    Rng a(kSeed), b(kSeed);
    for (int i = 0; i < 2000; ++i) {
      const auto one = runEstimator(Johnson{.n = 1}, c.line, Channels<3>{1, 2, 3}, a),
                 delta = runEstimator(TrackLength(), c.line, Channels<3>{1, 2, 3}, b);
      ASSERT_EQ(one.value, delta.value) << c.name;
      ASSERT_EQ(one.tally.lookups, delta.tally.lookups) << c.name;
    }
  }
}

TEST(Johnson, OnlyTakesPowersOfOneLessANth) {
  const TrackingCase c = trackingCase(shape("cosine"), 1, 1.5);
  Rng rng(kSeed);
  for (int i = 0; i < 2000; ++i) {
    const auto estimate = runEstimator(Johnson{.n = 3}, c.line, Channels<1>{1}, rng);
    const double real = static_cast<double>(estimate.tally.lookups - estimate.tally.nullCollisions);
    EXPECT_NEAR(estimate.value[0], std::pow(2. / 3, real), 1e-12);
  }
}

TEST(Johnson, CountsRealCollisionsWithAPoissonLaw) {
  // Negative control beside it: the law of one walk fewer.
  const TrackingCase c = trackingCase(shape("gaussian"), 1.5, 1.5);
  Rng rng(kSeed);
  std::vector<double> counted(40, 0), expected(40, 0), wrong(40, 0);
  constexpr int kN = 20000;
  for (int i = 0; i < kN; ++i) {
    const auto tally = runEstimator(Johnson{.n = 4}, c.line, Channels<1>{1.5}, rng).tally;
    ++counted.at(tally.lookups - tally.nullCollisions);
  }
  double pmf = std::exp(-6.), other = std::exp(-4.5);
  for (std::size_t k = 0; k < counted.size(); ++k) {
    expected[k] = kN * pmf;
    wrong[k] = kN * other;
    pmf *= 6. / (static_cast<double>(k) + 1);
    other *= 4.5 / (static_cast<double>(k) + 1);
  }
  EXPECT_GT(chiSquareTest(counted, expected).pValue(), kMinPValue) << chiSquareTest(counted, expected);
  EXPECT_LT(chiSquareTest(counted, wrong).pValue(), kMinPValue);
}

TEST(Johnson, IsItselfInEachChannel) {
  const Channels<3> sigma{3, 0, .5};
  for (const Shape& s : shapes()) {
    const TrackingCase c = trackingCase(s, 1, 1.5, 3);
    Rng rng(kSeed);
    RunningStats value[3], square[3];
    for (int i = 0; i < 10000; ++i) {
      const auto estimate = runEstimator(Johnson{.n = 3}, c.line, sigma, rng);
      for (std::size_t k = 0; k < 3; ++k) {
        value[k].add(estimate.value[k]);
        square[k].add(estimate.value[k] * estimate.value[k]);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      expectMean(value[k], std::exp(-sigma[k]), kSeed, c.name);
      expectMean(square[k], std::exp(-2 * sigma[k] + sigma[k] / 3), kSeed, c.name + ", squares");
    }
  }
}

TEST(Johnson, LeavesAnOpaqueMediumOnceNothingIsLeft) {
  const TrackingCase c = trackingCase(shape("constant"), 1e6, 1);
  Rng rng(kSeed);
  const auto estimate = runEstimator(Johnson{.n = 2}, c.line, Channels<1>{1e6}, rng);
  EXPECT_EQ(estimate.value[0], 0);
  EXPECT_LT(estimate.tally.lookups, 1100u);
}

}  // namespace
}  // namespace pbrtmedia
