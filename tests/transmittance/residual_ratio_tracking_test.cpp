// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/residual_ratio_tracking.h"

#include <gtest/gtest.h>

#include "tracking_cases.h"
#include "transmittance/estimators/ratio_tracking.h"
#include "transmittance/estimators/residual_track_length.h"

namespace pbrtmedia {
namespace {

using namespace test;

constexpr std::uint64_t kSeed = 20261102;

TEST(ResidualRatioTracking, IsRatioTrackingWithoutMinorants) {
  for (const Shape& s : shapes()) {
    for (const double control : {.7, 1., 3.}) {
      const TrackingCase c = trackingCase(s, 2, control, 5);
      Rng a(kSeed), b(kSeed);
      for (int i = 0; i < 1000; ++i) {
        const auto residual = runEstimator(ResidualRatioTracking(), c.line, Channels<3>{2, 0, 1}, a),
                   ratio = runEstimator(RatioTracking(), c.line, Channels<3>{2, 0, 1}, b);
        for (std::size_t k = 0; k < 3; ++k) {
          // Factors are differences from 1: their rounding is absolute.
          ASSERT_NEAR(residual.value[k], ratio.value[k], 1e-12) << c.name;
        }
      }
    }
  }
}

/// Three levels, each known from its bounds.
ProvenLine knownLine() {
  return {{[](double s) { return s < .3   ? 2.0
                                 : s < .6 ? 0.0
                                          : .5; },
           {{.3, {2, 2}}, {.6, {0, 0}}, {1, {.5f, .5f}}}}};
}

TEST(ResidualRatioTracking, IsExactAndFreeWhereBoundsLeaveNothingOpen) {
  Rng rng(kSeed);
  for (const double sigma : {1e-8, .1, 1., 30., 1e6}) {
    const auto grey = runEstimator(ResidualRatioTracking(), knownLine(), Channels<1>{sigma}, rng);
    EXPECT_NEAR(grey.value[0], std::exp(-.8 * sigma), 1e-12 * std::exp(-.8 * sigma)) << sigma;
    EXPECT_EQ(grey.tally.lookups, 0u);
    const auto delta = runEstimator(ResidualTrackLength(), knownLine(), Channels<1>{sigma}, rng);
    EXPECT_NEAR(delta.value[0], std::exp(-.8 * sigma), 1e-12 * std::exp(-.8 * sigma)) << sigma;
    EXPECT_EQ(delta.tally.lookups, 0u);
  }
}

TEST(ResidualRatioTracking, ProbesUnprovenStretchesItTrusts) {
  FunctionLine line = knownLine();
  Rng rng(kSeed);
  const auto good = runEstimator(ResidualRatioTracking(), line, Channels<1>{1}, rng);
  EXPECT_EQ(good.tally.lookups, 3u);
  EXPECT_EQ(good.tally.violations, 0u);
  line.function = [](double) { return 3.0; };
  for (const auto& tally : {runEstimator(ResidualRatioTracking(), line, Channels<1>{1}, rng).tally,
                            runEstimator(ResidualTrackLength(), line, Channels<1>{1}, rng).tally}) {
    EXPECT_EQ(tally.lookups, 3u);
    EXPECT_EQ(tally.violations, 3u);
  }
}

TEST(ResidualRatioTracking, MayStartFromAMinorantThatIsTooHigh) {
  // Any lower control will do for the mean and the second moment, where the upper one is above it.
  for (const Shape& s : shapes()) {
    TrackingCase c = trackingCase(s, .8, 1.2);
    c.line.intervals[0].bound.lower = .5f * c.line.intervals[0].bound.upper;
    const Moments m = measure(ResidualRatioTracking(), c.line, c.tau, 20000, kSeed);
    expectMean(m.value, std::exp(-c.tau), kSeed, c.name);
    const double second = std::exp(c.integrate([](double mu, double upper, double lower) {
      return -upper - lower + (upper - mu) * (upper - mu) / (upper - lower);
    }));
    expectMean(m.square, second, kSeed, c.name + ", squares");
  }
}

TEST(ResidualRatioTracking, CombinesExponentsOfAnOpaqueMediumFirst) {
  // exp(-minorant) alone is 0 in double; about 150 factors of -4 bring the estimate back into its range.
  const ProvenLine line{{[](double) { return 1.0; }, {{1, {.6f, .5f}}}}};
  Rng rng(kSeed);
  for (int i = 0; i < 100; ++i) {
    const auto estimate = runEstimator(ResidualRatioTracking(), line, Channels<1>{1500}, rng);
    EXPECT_TRUE(std::isfinite(estimate.value[0])) << estimate.value[0];
    EXPECT_NE(estimate.value[0], 0);
  }
}

TEST(ResidualRatioTracking, IntegratesMinorantsBehindItsLimit) {
  const ProvenLine line{{[](double) { return 1.5; }, {{.1, {900, 1}}, {.5, {2, 1}}, {1, {2, 1}}}}};
  Rng rng(kSeed);
  const auto estimate = runEstimator(ResidualRatioTracking{.maxLookups = 2}, line, Channels<1>{1}, rng);
  EXPECT_EQ(estimate.tally.capped, 1u);
  EXPECT_EQ(estimate.tally.lookups, 2u);
  const double factor = 1 - .5 / 899;
  EXPECT_NEAR(estimate.value[0], std::exp(-1.) * factor * factor, 1e-12);
  const auto delta = runEstimator(ResidualTrackLength{.maxLookups = 2}, line, Channels<1>{1}, rng);
  EXPECT_EQ(delta.tally.capped, 1u);
  EXPECT_NEAR(delta.value[0], std::exp(-1.), 1e-12);
}

TEST(ResidualRatioTracking, IsUnbiasedInEachChannel) {
  const Channels<3> sigma{0, 2, .3};
  for (const Shape& s : shapes()) {
    const TrackingCase c = trackingCase(s, 1, 1.5, 4, .7);
    Rng rng(kSeed);
    RunningStats ratio[3], delta[3];
    for (int i = 0; i < 10000; ++i) {
      const auto a = runEstimator(ResidualRatioTracking(), c.line, sigma, rng);
      const auto b = runEstimator(ResidualTrackLength(), c.line, sigma, rng);
      for (std::size_t k = 0; k < 3; ++k) {
        ratio[k].add(a.value[k]);
        delta[k].add(b.value[k]);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      expectMean(ratio[k], std::exp(-sigma[k]), kSeed, c.name);
      expectMean(delta[k], std::exp(-sigma[k]), kSeed, c.name + ", track length");
    }
  }
}

TEST(ResidualRatioTracking, RouletteKeepsTheMeanOfEveryChannelAndSavesLookups) {
  // The lower bounds alone leave e^-1 of the first channel, so that walks end by them too.
  const Channels<3> sigma{2, 0, .5};
  for (const Shape& s : shapes()) {
    TrackingCase c = trackingCase(s, 1, 1.5, 4, .7);
    for (const double threshold : {.3, 1.}) {
      for (const bool withoutClear : {false, true}) {
        // A channel of no extinction weighs 1 for ever: no walk ends.
        const Channels<3> sigmas = withoutClear ? Channels<3>{6, 3, 4.5} : sigma;
        const ResidualRatioTracking roulette{.rouletteThreshold = threshold};
        Rng a(kSeed), b(kSeed);
        RunningStats values[3], lookups, whole;
        for (int i = 0; i < 20000; ++i) {
          const auto some = runEstimator(roulette, c.line, sigmas, a);
          for (std::size_t k = 0; k < 3; ++k) values[k].add(some.value[k]);
          lookups.add(static_cast<double>(some.tally.lookups));
          whole.add(
              static_cast<double>(runEstimator(ResidualRatioTracking(), c.line, sigmas, b).tally.lookups));
        }
        for (std::size_t k = 0; k < 3; ++k) expectMean(values[k], std::exp(-sigmas[k]), kSeed, c.name);
        if (withoutClear && whole.mean() > .5) {
          EXPECT_LT(lookups.mean(), .8 * whole.mean()) << c.name << ", " << threshold;
        } else if (!withoutClear) {
          EXPECT_EQ(lookups.mean(), whole.mean()) << c.name;  // the same numbers: nothing is drawn
        }
      }
    }
  }
}

TEST(ResidualRatioTracking, RouletteOfLowerBoundsAloneIsUnbiasedWithoutOneCollision) {
  // A thousandth of the density is open: e^-4 is the lower bounds', and most walks end before the last cell.
  const int cells = 40;
  ProvenLine line{{[](double) { return 4.0; }, {}}};
  for (int i = 1; i <= cells; ++i)
    line.intervals.push_back({static_cast<double>(i) / cells, {4.004f, 3.996f}});
  const ResidualRatioTracking roulette{.rouletteThreshold = .5};
  Rng rng(kSeed);
  RunningStats values;
  int ended = 0;
  for (int i = 0; i < 20000; ++i) {
    const double value = runEstimator(roulette, line, Channels<1>{1}, rng).value[0];
    ended += value == 0;
    values.add(value);
    ASSERT_LE(value, .501);
  }
  expectMean(values, std::exp(-4.), kSeed, "even");
  // Alive with probability e^-4 / .5 or, between two questions, a little more.
  EXPECT_GT(ended, 0.9 * 20000);
  EXPECT_LT(ended, 0.97 * 20000);
}

TEST(ResidualTrackLength, TakesTwoValuesAndCountsDensitiesBelowTheirMinorant) {
  const TrackingCase c = trackingCase(shape("hole"), 1, 1.1);
  ProvenLine line = c.line;
  line.intervals[0].bound.lower = .25f;
  Rng rng(kSeed);
  std::uint64_t violations = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto estimate = runEstimator(ResidualTrackLength(), line, Channels<1>{1}, rng);
    ASSERT_TRUE(estimate.value[0] == 0 || estimate.value[0] == std::exp(-.25));
    violations += estimate.tally.violations;
  }
  EXPECT_GT(violations, 0u);
}

TEST(ResidualTrackLength, IsNoticedWhenTheMinorantIsForgotten) {
  // Negative control: the mean of delta tracking above a minorant is not T without the minorant's factor.
  const TrackingCase c = trackingCase(shape("cosine"), 1, 1.5, 7, .9);
  const Moments m = measure(ResidualTrackLength(), c.line, 1, 20000, kSeed);
  const double minorant = c.integrate([](double, double, double lower) { return lower; });
  EXPECT_GT(minorant, .05);
  EXPECT_GT(std::abs(zTest(m.value, std::exp(-1. + minorant), kSeed).z()), kMaxAbsZ);
}

}  // namespace
}  // namespace pbrtmedia
