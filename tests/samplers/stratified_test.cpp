// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "samplers/all_samplers.h"

namespace pbrtmedia {
namespace {

using namespace test;

TEST(Stratified, EachRoundFillsEachCellOnceInEverySlot) {
  StratifiedSampler s({.xSamples = 5, .ySamples = 3, .dimensions = 3});
  for (int p = 0; p < 20; ++p) {
    for (const int slot : {0, 1, 2}) {
      for (const std::int64_t round : {0, 1, 1000})
        EXPECT_TRUE(oneInEachCell(slotPoints(s, {p, 3}, slot, round * 15, 15), 5, 3)) << slot;
    }
  }
}

TEST(Stratified, SingleNumbersFillEqualIntervals) {
  StratifiedSampler s({.xSamples = 6, .ySamples = 6});
  std::vector<Point2f> points;
  for (int i = 0; i < 36; ++i) {
    s.start({5, 5}, i);
    s.get2D();
    points.push_back({s.get1D(), 0});
  }
  EXPECT_TRUE(oneInEachCell(points, 36, 1));
}

TEST(Stratified, WithoutJitterTakesCellCentres) {
  StratifiedSampler s({.xSamples = 4, .ySamples = 2, .jitter = false});
  for (const Point2f p : slotPoints(s, {7, 7}, 1, 0, 8)) {
    EXPECT_EQ(p.x * 8 - 1, 2 * std::floor(p.x * 4));
    EXPECT_EQ(p.y * 4 - 1, 2 * std::floor(p.y * 2));
  }
  s.start({7, 7}, 0);
  const float t = s.get1D();
  EXPECT_EQ(t * 16 - 1, 2 * std::floor(t * 8));
}

TEST(Stratified, VisitsTheCellsInADifferentOrderInEverySlotRoundAndPixel) {
  StratifiedSampler s({.xSamples = 4, .ySamples = 4, .jitter = false});
  const auto first = slotPoints(s, {1, 1}, 0, 0, 16);
  EXPECT_NE(first, slotPoints(s, {1, 1}, 1, 0, 16));
  EXPECT_NE(first, slotPoints(s, {1, 1}, 0, 16, 16));
  EXPECT_NE(first, slotPoints(s, {2, 1}, 0, 0, 16));
}

TEST(Stratified, SlotsPastItsDimensionsAreRandom) {
  StratifiedSampler s({.xSamples = 8, .ySamples = 8, .jitter = false, .dimensions = 1});
  EXPECT_TRUE(oneInEachCell(slotPoints(s, {1, 1}, 0, 0, 64), 8, 8));
  EXPECT_FALSE(oneInEachCell(slotPoints(s, {1, 1}, 1, 0, 64), 8, 8));
}

TEST(Stratified, ArrayElementsOfAllSamplesFillAGrid) {
  StratifiedSampler s({.xSamples = 3, .ySamples = 2});
  std::vector<Point2f> all, one(8);  // 8 = 2 x 4, so 6 x 8 cells
  for (int i = 0; i < 6; ++i) {
    s.start({2, 2}, i);
    s.get2DArray(one);
    all.insert(all.end(), one.begin(), one.end());
  }
  EXPECT_TRUE(oneInEachCell(all, 6, 8));
}

TEST(Stratified, OneSamplePerPixelIsJustUniform) {
  StratifiedSampler s({.xSamples = 1, .ySamples = 1});
  EXPECT_NE(slotPoints(s, {0, 0}, 0, 0, 1), slotPoints(s, {1, 0}, 0, 0, 1));
}

}  // namespace
}  // namespace pbrtmedia
