// SPDX-License-Identifier: BSD-2-Clause
#include "singlescattering/main_part.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/rng.h"
#include "singlescattering/scattering_distances.h"
#include "support/function_line.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using namespace test;

const std::vector<Explorer> kExplorers = {
    {1.5, Rgb(1, 0, 4), .1}, {2, Rgb(3, 0, 0), .5}, {4, Rgb(0, 0, 1), .2}};

TEST(MainPart, IsLinearBetweenExplorersAndConstantBeyond) {
  const MainPart part(kExplorers, 1, 5);
  EXPECT_EQ(part.length(), 4);
  EXPECT_EQ(part.largestDifference(), .5);
  for (const auto& [t, red, blue] :
       {std::array{1.2, 1.0, 4.0}, {1.75, 2.0, 2.0}, {3.0, 1.5, .5}, {4.6, 0.0, 1.0}}) {
    EXPECT_NEAR(part.at(t).extinction[0], red, 1e-12) << t;
    EXPECT_NEAR(part.at(t).extinction[1], 0, 0) << t;
    EXPECT_NEAR(part.at(t).extinction[2], blue, 1e-12) << t;
  }
  EXPECT_NEAR(part.depth()[0], .5 * 1 + .5 * 2 + 2 * 1.5, 1e-12);
  EXPECT_NEAR(part.depth()[2], .5 * 4 + .5 * 2 + 2 * .5 + 1, 1e-12);
}

TEST(MainPart, DepthIsTheIntegralOfTheExtinctionAndItsInverse) {
  const MainPart part(kExplorers, 1, 5);
  double sums[3] = {};
  constexpr int kSteps = 4000;
  for (int i = 0; i < kSteps; ++i) {
    const double h = 4.0 / kSteps, t = 1 + i * h;
    const MainPart::Value value = part.at(t);
    for (const std::size_t c : {0, 2}) {
      EXPECT_NEAR(value.depth[c], sums[c], 1e-9);
      // Where nothing is, any distance has the same depth.
      EXPECT_NEAR(part.at(part.invert(c, value.depth[c])).depth[c], value.depth[c], 1e-12);
      if (value.extinction[c] > 0) {
        EXPECT_NEAR(part.invert(c, value.depth[c]), t, 1e-6);
      }
      sums[c] += part.at(t + h / 2).extinction[c] * h;
    }
  }
}

TEST(MainPart, OneExplorerIsEnough) {
  const std::vector<Explorer> one = {{2, Rgb(2), 0}};
  const MainPart part(one, 2, 3);
  EXPECT_EQ(part.at(2.25).depth[1], .5);
  EXPECT_EQ(part.invert(1, .5), 2.25);
}

TEST(ScatteringDistances, DensityIntegratesToOneAndIsThatOfItsSamples) {
  const std::vector<Explorer> nothing = {{2, Rgb(), 0}};
  for (const std::vector<Explorer>& explorers : {kExplorers, nothing}) {
    const MainPart part(explorers, 1, 5);
    const ScatteringDistances distances(part);
    EXPECT_NEAR(simpson([&](double t) { return distances.pdf(t); }, 1, 5), 1, 1e-4);
    Rng rng(5);
    RunningStats inverse, mean;
    for (int i = 0; i < 20000; ++i) {
      const double t = distances.sample(rng.uniformDouble());
      ASSERT_TRUE(t >= 1 && t <= 5);
      ASSERT_GT(distances.pdf(t), 0);
      inverse.add(1 / distances.pdf(t));
      mean.add(t);
    }
    const ZTest length = zTest(inverse, 4);
    EXPECT_LT(std::abs(length.z()), kMaxAbsZ) << length;
    const ZTest middle = zTest(mean, simpson([&](double t) { return t * distances.pdf(t); }, 1, 5));
    EXPECT_LT(std::abs(middle.z()), kMaxAbsZ) << middle;
  }
}

}  // namespace
}  // namespace pbrtmedia
