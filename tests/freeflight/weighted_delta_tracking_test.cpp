// SPDX-License-Identifier: BSD-2-Clause
#include "freeflight/weighted_delta_tracking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "freeflight/flight_list.h"
#include "support/function_line.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::FunctionLine;
using test::kMaxAbsZ;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20240608;

/// A ramp 2s on [0, 1] under bounds in four cells; the integral from 0 to s is s².
FunctionLine ramp(bool withLowerBounds) {
  FunctionLine line{[](double s) { return 2 * s; }, {}};
  for (int i = 0; i < 4; ++i) {
    line.intervals.push_back({(i + 1) / 4.0, {(i + 1) / 2.0f, withLowerBounds ? i / 2.0f : 0}});
  }
  return line;
}

TEST(WeightedDeltaTracking, DrawsDistancesFromTheExactDistribution) {
  for (const bool withLowerBounds : {false, true}) {
    for (const double sigma : {.3, 2., 20.}) {
      const FunctionLine line = ramp(withLowerBounds);
      Rng rng(kSeed);
      SampleStream stream(rng);
      std::vector<double> distances;
      constexpr double kN = 200000;
      double passed = 0;
      for (double n = 0; n < kN; ++n) {
        const auto flight = WeightedDeltaTracking()(line, FlightQuery<1>{{sigma}}, stream);
        ASSERT_EQ(flight.weight[0], 1.0);
        passed += flight.collided ? 0 : 1;
        if (flight.collided) distances.push_back(flight.s);
      }
      const double truth = std::exp(-sigma);
      EXPECT_LT(std::abs(passed / kN - truth) / std::sqrt(truth * (1 - truth) / kN), kMaxAbsZ)
          << sigma << ": " << passed << " of " << kN << " passed";
      const auto ks =
          test::ksTest(distances, [&](double s) { return std::expm1(-sigma * s * s) / std::expm1(-sigma); });
      EXPECT_GT(ks.pValue(), test::kMinPValue) << sigma << ": " << ks;
      // Negative control: the distribution of a constant density of the same depth.
      const auto wrong =
          test::ksTest(distances, [&](double s) { return std::expm1(-sigma * s) / std::expm1(-sigma); });
      EXPECT_LT(wrong.pValue(), test::kMinPValue) << wrong;
    }
  }
}

/// The same with bounds that count as proven.
struct ProvenLine : FunctionLine {
  static constexpr bool hasProvenBounds() { return true; }
};

TEST(WeightedDeltaTracking, AsksForNoDensityWhereLowerAndUpperBoundAgree) {
  const ProvenLine line{{[](double) { return 2.0; }, {{1, {2, 2}}}}};
  Rng rng(kSeed);
  SampleStream stream(rng);
  std::vector<double> distances;
  for (int n = 0; n < 50000; ++n) {
    const auto flight = WeightedDeltaTracking()(line, FlightQuery<1>{{3}}, stream);
    ASSERT_EQ(flight.tally.lookups, 0u);
    ASSERT_EQ(flight.tally.nullCollisions, 0u);
    if (flight.collided) distances.push_back(flight.s);
  }
  const auto ks = test::ksTest(distances, [](double s) { return std::expm1(-6 * s) / std::expm1(-6.0); });
  EXPECT_GT(ks.pValue(), test::kMinPValue) << ks;
}

TEST(WeightedDeltaTracking, DoesNotTrustALowerBoundThatNobodyProved) {
  // The density is half of its lower bound: taken for certain, every second collision would be one too many.
  const FunctionLine line{[](double) { return 1.0; }, {{1, {4, 2}}}};
  Rng rng(kSeed);
  SampleStream stream(rng);
  for (const AnyFlight& sampler :
       {AnyFlight(WeightedDeltaTracking{}), AnyFlight(DeltaTracking{}), AnyFlight(DecompositionTracking{})}) {
    RunningStats passed;
    for (int n = 0; n < 100000; ++n) {
      const auto flight = visitFlight(
          [&](const auto& held) {
            return flyOn(held, line, FlightQuery<1>{{1}, {.5}}, stream);
          },
          sampler);
      passed.add(flight.collided ? 0 : flight.weight[0]);
    }
    const auto test = zTest(passed, std::exp(-1.0), kSeed);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << nameOf(sampler) << test;
  }
}

TEST(WeightedDeltaTracking, PassesVacuumAndClearMedia) {
  const FunctionLine vacuum{[](double) { return 0.0; }, {{1, {0, 0}}}};
  Rng rng(1);
  SampleStream stream(rng);
  EXPECT_FALSE(WeightedDeltaTracking()(vacuum, FlightQuery<1>{{5}}, stream).collided);
  const auto clear = WeightedDeltaTracking()(ramp(true), FlightQuery<3>{{0, 0, 0}}, stream);
  EXPECT_FALSE(clear.collided);
  EXPECT_EQ(clear.weight, filled<3>(1));
  EXPECT_EQ(clear.tally.lookups, 0u);
}

TEST(WeightedDeltaTracking, NeverChoosesAnEventOfProbabilityZero) {
  const FunctionLine nothing{[](double) { return 0.0; }, {{1, {1, 0}}}};
  const FunctionLine everything{[](double) { return 1.0; }, {{1, {1, 0}}}};
  Rng rng(kSeed);
  SampleStream stream(rng);
  for (int n = 0; n < 200000; ++n) {
    ASSERT_FALSE(WeightedDeltaTracking()(nothing, FlightQuery<1>{{3}}, stream).collided);
    ASSERT_EQ(WeightedDeltaTracking()(everything, FlightQuery<1>{{3}}, stream).tally.nullCollisions, 0u);
    const auto passed = WeightedDeltaTracking()(nothing, FlightQuery<3>{{0, 1, 3}}, stream);
    ASSERT_FALSE(passed.collided);
    for (const double w : passed.weight) ASSERT_NEAR(w, 1, 1e-9);
  }
}

TEST(WeightedDeltaTracking, StaysRightInVeryDenseMedia) {
  for (const double sigma : {50., 1e3, 1e6}) {
    const FunctionLine line{[](double) { return 1.0; }, {{.5, {2, 0}}, {1, {1, 0}}}};
    Rng rng(kSeed);
    SampleStream stream(rng);
    std::vector<double> depths;
    for (int n = 0; n < 20000; ++n) {
      const auto flight = WeightedDeltaTracking()(line, FlightQuery<1>{{sigma}}, stream);
      ASSERT_TRUE(flight.collided);
      depths.push_back(sigma * flight.s);
    }
    const auto ks = test::ksTest(depths, [](double x) { return -std::expm1(-x); });
    EXPECT_GT(ks.pValue(), test::kMinPValue) << sigma << ": " << ks;
  }
}

TEST(WeightedDeltaTracking, FindsTheRareCollisionsOfThinMedia) {
  const FunctionLine line = ramp(false);
  constexpr double kTau = 1e-6, kN = 1.6e7;
  Rng rng(kSeed);
  SampleStream stream(rng);
  double collisions = 0;
  for (double n = 0; n < kN; ++n)
    collisions += WeightedDeltaTracking()(line, FlightQuery<1>{{kTau}}, stream).collided ? 1 : 0;
  EXPECT_LT(std::abs(collisions - kN * kTau) / std::sqrt(kN * kTau), kMaxAbsZ) << collisions;
}

/// Expected weights per channel: passed T, collided 1 - T, and the mean place of collisions.
void checkWeights(const FunctionLine& line, const Channels<3>& sigma, double largestWeight) {
  Rng rng(kSeed);
  SampleStream stream(rng);
  RunningStats passed[3], collided[3], place[3];
  for (int n = 0; n < 400000; ++n) {
    const auto flight = WeightedDeltaTracking()(line, FlightQuery<3>{sigma}, stream);
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double w = flight.weight[c];
      ASSERT_LE(std::abs(w), largestWeight);
      sum += w;
      passed[c].add(flight.collided ? 0 : w);
      collided[c].add(flight.collided ? w : 0);
      place[c].add(flight.collided ? w * flight.s : 0);
    }
    if (largestWeight < 4) {
      ASSERT_NEAR(sum, 3, 1e-9);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const double t = std::exp(-sigma[c]);
    // Density 2s: integral of s 2s sigma exp(-sigma s²).
    const double mean =
        test::simpson([&](double s) { return 2 * sigma[c] * s * s * std::exp(-sigma[c] * s * s); }, 0, 1);
    for (const auto& test :
         {zTest(passed[c], t, kSeed), zTest(collided[c], 1 - t, kSeed), zTest(place[c], mean, kSeed)}) {
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "channel " << c << ": " << test;
    }
  }
}

TEST(WeightedDeltaTracking, WeighsEachChannelRightInAChromaticMedium) {
  checkWeights(ramp(false), {0, 1, 10}, 3 + 1e-9);
  checkWeights(ramp(true), {5, .01, 2}, 3 + 1e-9);
  checkWeights(ramp(true), {2, 2, 2}, 1 + 1e-9);
}

TEST(WeightedDeltaTracking, StaysUnbiasedAndCountsWhereABoundIsViolated) {
  // Lower bounds decide some collisions before the density is known: of the others the weights must know
  // that.
  for (const float lowerShare : {0.f, .5f}) {
    ProvenLine line{ramp(true)};
    for (auto& interval : line.intervals) {
      interval.bound.upper *= .75f;
      interval.bound.lower *= lowerShare;
    }
    checkWeights(line, {.5, 1, 2}, 1e3);
    Rng rng(kSeed);
    SampleStream stream(rng);
    RunningStats passed, collided;
    LookupTally worst;
    for (int n = 0; n < 400000; ++n) {
      const auto flight = WeightedDeltaTracking()(line, FlightQuery<1>{{2}}, stream);
      ASSERT_TRUE(std::isfinite(flight.weight[0]));
      passed.add(flight.collided ? 0 : flight.weight[0]);
      collided.add(flight.collided ? flight.weight[0] : 0);
      worst.violations += flight.tally.violations;
      worst.worstRatio = std::max(worst.worstRatio, flight.tally.worstRatio);
    }
    EXPECT_GT(worst.violations, 1000u);
    EXPECT_NEAR(worst.worstRatio, 4. / 3, 1e-3);
    const auto through = zTest(passed, std::exp(-2.0), kSeed),
               stopped = zTest(collided, 1 - std::exp(-2.0), kSeed);
    EXPECT_LT(std::abs(through.z()), kMaxAbsZ) << lowerShare << ": " << through;
    EXPECT_LT(std::abs(stopped.z()), kMaxAbsZ) << lowerShare << ": " << stopped;
  }
}

TEST(WeightedDeltaTracking, CountsDensityUnderABoundOfZeroAndEnds) {
  const FunctionLine line{[](double) { return 3.0; }, {{1, {0, 0}}}};
  Rng rng(1);
  SampleStream stream(rng);
  const auto flight = WeightedDeltaTracking()(line, FlightQuery<1>{{1}}, stream);
  EXPECT_FALSE(flight.collided);
  EXPECT_EQ(flight.tally.violations, 1u);
  EXPECT_EQ(flight.tally.worstRatio, std::numeric_limits<double>::infinity());
}

TEST(AnyFlight, IsFoundByEveryNameOfTheList) {
  const auto names = flightNames();
  EXPECT_EQ(names.size(), std::variant_size_v<FlightVariant>);
  for (const auto name : names) {
    const auto sampler = findFlight(name);
    ASSERT_TRUE(sampler) << name;
    EXPECT_EQ(nameOf(*sampler), name);
  }
  EXPECT_FALSE(findFlight("gamma"));
}

}  // namespace
}  // namespace pbrtmedia
