// SPDX-License-Identifier: BSD-2-Clause
#include "media/homogeneous.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/diagnostics.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20240610;

HomogeneousMedium medium(Rgb sigmaA, Rgb sigmaS) {
  return HomogeneousMedium({.name = "fog", .sigmaA = sigmaA, .sigmaS = sigmaS, .overlap = {}});
}
Segment ofLength(double length) { return {{1, 2, 3}, {0, 0, 1}, .5, .5 + length}; }

TEST(HomogeneousMedium, FollowsBeerLambertOverTheWholeLadder) {
  Rng rng;
  RenderCounters counters;
  for (const double tau : {1e-6, 1e-3, .1, 1., 5., 20., 50., 87., 88., 104., 1e3, 1e6}) {
    const float t = medium(Rgb(1), Rgb(1)).transmittance(ofLength(tau / 2), rng, counters).r;
    EXPECT_NEAR(t, std::exp(-tau), 1e-6 * std::exp(-tau) + std::numeric_limits<float>::denorm_min()) << tau;
  }
  EXPECT_NEAR(medium(Rgb(0), Rgb(1)).transmittance(ofLength(2), rng, counters).g, .13534, 1e-5);
  EXPECT_EQ(medium(Rgb(1), Rgb(1)).transmittance(ofLength(0), rng, counters), Rgb(1));
  const Rgb chromatic = medium(Rgb(0), Rgb(0, 1, 10)).transmittance(ofLength(2), rng, counters);
  EXPECT_EQ(chromatic.r, 1);
  EXPECT_NEAR(chromatic.g, std::exp(-2.0), 1e-7);
  EXPECT_NEAR(chromatic.b, std::exp(-20.0), 1e-14);
  EXPECT_EQ(counters.densityLookups, 0u);
}

TEST(HomogeneousMedium, EndsAtInfinityUnlessAChannelIsClear) {
  Rng rng(kSeed);
  RenderCounters counters;
  const Segment forever{{}, {0, 0, 1}, 0, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(medium(Rgb(1), Rgb(0)).transmittance(forever, rng, counters), Rgb(0));
  EXPECT_EQ(medium(Rgb(0), Rgb(0, 1, 2)).transmittance(forever, rng, counters), Rgb(1, 0, 0));
  for (int n = 0; n < 1000; ++n) {
    EXPECT_TRUE(medium(Rgb(1), Rgb(1)).sampleFreeFlight(forever, Rgb(1), rng, counters).collided);
    const FreeFlight flight = medium(Rgb(0), Rgb(0, 1, 2)).sampleFreeFlight(forever, Rgb(1), rng, counters);
    EXPECT_TRUE(flight.weight.isFinite()) << flight.weight;
    if (!flight.collided) {
      EXPECT_EQ(flight.weight, Rgb(3, 0, 0));
    }
  }
}

TEST(HomogeneousMedium, FliesGreyWithTheAlbedoAsWeight) {
  const HomogeneousMedium fog = medium(Rgb(1.5f), Rgb(.5f));
  Rng rng(kSeed);
  RenderCounters counters;
  std::vector<double> depths;
  RunningStats passed;
  for (int n = 0; n < 100000; ++n) {
    const FreeFlight flight = fog.sampleFreeFlight(ofLength(1), Rgb(1), rng, counters);
    passed.add(flight.collided ? 0 : 1);
    EXPECT_EQ(flight.weight, Rgb(flight.collided ? .25f : 1.0f));
    if (flight.collided) depths.push_back(flight.t - .5);
  }
  const auto through = zTest(passed, std::exp(-2.0), kSeed);
  EXPECT_LT(std::abs(through.z()), kMaxAbsZ) << through;
  const auto ks = test::ksTest(depths, [](double x) { return std::expm1(-2 * x) / std::expm1(-2.0); });
  EXPECT_GT(ks.pValue(), test::kMinPValue) << ks;
}

TEST(HomogeneousMedium, WeighsEveryChannelRight) {
  const Rgb sigmaA(.2f, 0, 5), sigmaS(0, 1, 5);
  const HomogeneousMedium fog = medium(sigmaA, sigmaS);
  for (const double length : {.01, 1., 30.}) {
    Rng rng(kSeed);
    RenderCounters counters;
    RunningStats passed[3], scattered[3], place[3];
    for (int n = 0; n < 300000; ++n) {
      const FreeFlight flight = fog.sampleFreeFlight(ofLength(length), Rgb(1), rng, counters);
      for (std::size_t c = 0; c < 3; ++c) {
        const double w = flight.weight[c];
        ASSERT_TRUE(w >= 0 && w <= 3.001);
        passed[c].add(flight.collided ? 0 : w);
        scattered[c].add(flight.collided ? w : 0);
        place[c].add(flight.collided ? w * (flight.t - .5) : 0);
      }
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const double sigmaT = double{sigmaA[c]} + double{sigmaS[c]}, t = std::exp(-sigmaT * length);
      const double albedo = sigmaS[c] / sigmaT, mean = albedo * ((1 - t) / sigmaT - length * t);
      for (const auto& test : {zTest(passed[c], t, kSeed), zTest(scattered[c], albedo * (1 - t), kSeed),
                               zTest(place[c], mean, kSeed)}) {
        // A transmittance far below 1/n never shows up in n samples: its mean is 0 and its truth nearly so.
        if (test.truth < 1e-7) continue;
        EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "channel " << c << ", length " << length << ": " << test;
      }
    }
  }
}

TEST(HomogeneousMedium, ScattersOnceMoreInAFurnaceOfAnyDepth) {
  // Without absorption passed and scattered weights must add up to 1 per channel, however deep.
  for (const double length : {1e-2, 1., 1e3, 1e6}) {
    Rng rng(kSeed);
    RenderCounters counters;
    RunningStats sum[3];
    for (int n = 0; n < 100000; ++n) {
      const FreeFlight flight =
          medium(Rgb(0), Rgb(1, 2, 4)).sampleFreeFlight(ofLength(length), Rgb(1), rng, counters);
      ASSERT_TRUE(flight.weight.isFinite());
      for (std::size_t c = 0; c < 3; ++c) sum[c].add(flight.weight[c]);
    }
    for (std::size_t c = 0; c < 3; ++c) {
      // Float weights round by up to 6e-8.
      const auto test = zTest(sum[c], 1, kSeed);
      EXPECT_TRUE(std::abs(test.z()) < kMaxAbsZ || std::abs(test.mean - 1) < 1e-6) << test;
    }
  }
}

TEST(HomogeneousMedium, PassesWhereItIsClearAndWhereNothingIsLeft) {
  Rng rng(1);
  RenderCounters counters;
  const FreeFlight clear = medium(Rgb(0), Rgb(0)).sampleFreeFlight(ofLength(1e30), Rgb(1), rng, counters);
  EXPECT_FALSE(clear.collided);
  EXPECT_EQ(clear.weight, Rgb(1));
  for (int n = 0; n < 1000; ++n) {
    EXPECT_FALSE(medium(Rgb(1), Rgb(1, 2, 3)).sampleFreeFlight(ofLength(0), Rgb(1), rng, counters).collided);
  }
}

TEST(HomogeneousMedium, RefusesCoefficientsThatAreNone) {
  EXPECT_THROW(medium(Rgb(-1), Rgb(1)), SceneError);
  EXPECT_THROW(medium(Rgb(1), Rgb(1, std::numeric_limits<float>::quiet_NaN(), 1)), SceneError);
  EXPECT_THROW(medium(Rgb(kInfinity), Rgb(1)), SceneError);
  EXPECT_THROW(medium(Rgb(3e38f), Rgb(3e38f)), SceneError);
  EXPECT_THROW(HomogeneousMedium({.name = "fog", .phase = {PhaseLobe{.g = 1.5f}}, .overlap = {}}),
               SceneError);
}

}  // namespace
}  // namespace pbrtmedia
