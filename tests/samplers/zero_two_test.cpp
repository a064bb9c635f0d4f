// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "samplers/all_samplers.h"

namespace pbrtmedia {
namespace {

using namespace test;

TEST(ZeroTwo, EveryPrefixAndLaterBlockOfASlotIsANet) {
  ZeroTwoSampler s({.pixelSamples = 64, .dimensions = 10});
  for (int p = 0; p < 20; ++p) {
    for (const int slot : {0, 1, 5}) {
      for (int n = 1; n <= 64; n *= 2)
        EXPECT_TRUE(isNet(slotPoints(s, {p, 3}, slot, 0, n))) << slot << ' ' << n;
      EXPECT_TRUE(isNet(slotPoints(s, {p, 3}, slot, 64, 64)));
      EXPECT_TRUE(isNet(slotPoints(s, {p, 3}, slot, 0, 256)));
    }
  }
}

TEST(ZeroTwo, NetTestRejectsRandomPoints) {
  RandomSampler s({});
  EXPECT_FALSE(isNet(slotPoints(s, {1, 3}, 0, 0, 64)));
}

TEST(ZeroTwo, SingleNumbersFillEqualIntervals) {
  ZeroTwoSampler s({.pixelSamples = 32});
  std::vector<Point2f> points;
  for (int i = 0; i < 32; ++i) {
    s.start({5, 5}, i);
    s.get2D();
    points.push_back({s.get1D(), 0});
  }
  EXPECT_TRUE(oneInEachCell(points, 32, 1));
}

TEST(ZeroTwo, SlotsPastItsDimensionsAreRandom) {
  ZeroTwoSampler s({.pixelSamples = 64, .dimensions = 2});
  EXPECT_TRUE(isNet(slotPoints(s, {1, 1}, 1, 0, 64)));
  EXPECT_FALSE(isNet(slotPoints(s, {1, 1}, 2, 0, 64)));
  std::vector<Point2f> third;
  for (int i = 0; i < 64; ++i) {
    s.start({1, 1}, i);
    s.get1D();
    s.get1D();
    third.push_back({s.get1D(), 0});
  }
  EXPECT_FALSE(oneInEachCell(third, 64, 1));
}

TEST(ZeroTwo, ArrayElementsOfAllSamplesAreOneNet) {
  ZeroTwoSampler s({.pixelSamples = 16});
  std::vector<Point2f> all, one(4);
  for (int i = 0; i < 16; ++i) {
    s.start({2, 2}, i);
    s.get2DArray(one);
    EXPECT_TRUE(isNet(one));
    all.insert(all.end(), one.begin(), one.end());
  }
  EXPECT_TRUE(isNet(all));
}

}  // namespace
}  // namespace pbrtmedia
