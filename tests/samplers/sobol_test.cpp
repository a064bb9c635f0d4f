// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "samplers/all_samplers.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using namespace test;

TEST(SobolSampler, EveryPairIsANetInPrefixesAndLaterBlocks) {
  SobolSampler s({.pixelSamples = 64});
  for (int p = 0; p < 20; ++p) {
    for (const int slot : {0, 1, 7, 100}) {
      for (int n = 1; n <= 64; n *= 2)
        EXPECT_TRUE(isNet(slotPoints(s, {p, 3}, slot, 0, n))) << slot << ' ' << n;
      EXPECT_TRUE(isNet(slotPoints(s, {p, 3}, slot, 64, 64)));
      EXPECT_TRUE(isNet(slotPoints(s, {p, 3}, slot, 0, 256)));
    }
  }
}

TEST(SobolSampler, SingleNumbersFillEqualIntervalsHoweverManyAreTaken) {
  SobolSampler s({.pixelSamples = 32});
  for (int k = 0; k < 11; ++k) {
    std::vector<Point2f> points;
    for (int i = 0; i < 32; ++i) {
      s.start({5, 5}, i);
      s.get2D();
      for (int j = 0; j < k; ++j) s.get1D();
      points.push_back({s.get1D(), 0});
    }
    EXPECT_TRUE(oneInEachCell(points, 32, 1)) << k;
  }
}

// The number after a pair belongs to the same points in three dimensions: their product integrates far better
// than with independent 02-sequence slots.
TEST(SobolSampler, StratifiesANumberTogetherWithThePairBeforeIt) {
  const auto variance = [](Sampler& s) {
    RunningStats means;
    for (int p = 0; p < 1000; ++p) {
      double sum = 0;
      for (int i = 0; i < 64; ++i) {
        s.start({p, 0}, i);
        const Point2f u = s.get2D();
        sum += u.x * u.y * s.get1D() / 64;
      }
      means.add(sum);
    }
    EXPECT_LT(std::abs(zTest(means, 0.125).z()), kMaxAbsZ) << zTest(means, 0.125);
    return means.variance();
  };
  SobolSampler sobol({.pixelSamples = 64});
  ZeroTwoSampler padded({.pixelSamples = 64});
  EXPECT_LT(variance(sobol), 0.25 * variance(padded));
}

}  // namespace
}  // namespace pbrtmedia
