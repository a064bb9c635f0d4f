// SPDX-License-Identifier: BSD-2-Clause
#include "fields/grid_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "support/grids.h"

namespace pbrtmedia {
namespace {

using test::randomGrid;

GridSamples samplesOf(const GridField::Params& p, GridPrecision precision, GridLayout layout) {
  return GridSamples(p.nx, p.ny, p.nz, p.density, p.border, precision, layout);
}

TEST(GridSamples, HoldTheirApronInEitherLayout) {
  for (const GridBorder border : {GridBorder::Zero, GridBorder::Clamp}) {
    const auto params = randomGrid(17, 9, 7, border, .2f, 1);
    for (const GridLayout layout : {GridLayout::Linear, GridLayout::Bricked}) {
      const GridSamples samples = samplesOf(params, GridPrecision::Float, layout);
      for (int k = 0; k < 9; ++k) {
        for (int j = 0; j < 11; ++j) {
          for (int i = 0; i < 19; ++i) {
            const int ci = std::clamp(i, 1, 17), cj = std::clamp(j, 1, 9), ck = std::clamp(k, 1, 7);
            const bool inside = ci == i && cj == j && ck == k;
            const float own = params.density[static_cast<std::size_t>(((ck - 1) * 9 + cj - 1) * 17 + ci - 1)];
            ASSERT_EQ(samples.at(i, j, k), inside || border == GridBorder::Clamp ? own : 0.0f);
          }
        }
      }
    }
  }
}

TEST(GridSamples, AnswerTheSameInEitherLayout) {
  Rng rng(2);
  for (const GridPrecision precision : {GridPrecision::Float, GridPrecision::Half}) {
    const auto params = randomGrid(21, 14, 33, GridBorder::Zero, .2f, 3);
    const GridSamples linear = samplesOf(params, precision, GridLayout::Linear);
    const GridSamples bricked = samplesOf(params, precision, GridLayout::Bricked);
    for (int n = 0; n < 100000; ++n) {
      const Vec3d p(.5 + 21 * rng.uniformDouble(), .5 + 14 * rng.uniformDouble(),
                    .5 + 33 * rng.uniformDouble());
      ASSERT_EQ(linear.view().density(p), bricked.view().density(p)) << p.x << ' ' << p.y << ' ' << p.z;
    }
  }
}

TEST(GridSamples, StoreHalvesWithinTheErrorThatTheyState) {
  for (const float peak : {1.0f, 3e-30f, 7e25f, 65504.0f, .999f}) {
    auto params = randomGrid(12, 12, 12, GridBorder::Zero, 0, 4);
    for (float& v : params.density) v *= peak;
    params.density[5] = peak * 1e-12f;
    const float largest = *std::max_element(params.density.begin(), params.density.end());
    const GridSamples samples = samplesOf(params, GridPrecision::Half, GridLayout::Linear);
    for (int k = 1; k <= 12; ++k) {
      for (int j = 1; j <= 12; ++j) {
        for (int i = 1; i <= 12; ++i) {
          const double truth = static_cast<double>(
              params.density[static_cast<std::size_t>(((k - 1) * 12 + j - 1) * 12 + i - 1)]);
          const double allowed = truth >= 0x1p-28 * static_cast<double>(largest)
                                     ? 0x1p-11 * truth
                                     : 0x1p-39 * static_cast<double>(largest);
          ASSERT_NEAR(static_cast<double>(samples.at(i, j, k)), truth, allowed);
        }
      }
    }
  }
}

TEST(GridSamples, StoreTheSmallestAndTheLargestFloatsAsFiniteHalves) {
  constexpr float kMax = std::numeric_limits<float>::max(), kMin = std::numeric_limits<float>::denorm_min();
  const auto only = [](float v) {
    const std::vector<float> density{v};
    return GridSamples(1, 1, 1, density, GridBorder::Clamp, GridPrecision::Half, GridLayout::Linear)
        .at(1, 1, 1);
  };
  EXPECT_EQ(only(0), 0.0f);
  EXPECT_EQ(only(kMin), kMin);
  EXPECT_TRUE(std::isfinite(only(kMax)));
  EXPECT_GE(only(kMax), kMax * (1 - 0x1p-11f));
}

TEST(GridSamples, HalveTheirMemory) {
  const auto params = randomGrid(62, 62, 62, GridBorder::Zero, 0, 5);
  EXPECT_EQ(samplesOf(params, GridPrecision::Float, GridLayout::Linear).bytes(), 64u * 64 * 64 * 4);
  EXPECT_EQ(samplesOf(params, GridPrecision::Half, GridLayout::Linear).bytes(), 64u * 64 * 64 * 2 + 8);
}

TEST(GridSamples, CanBeMoved) {
  const auto params = randomGrid(5, 6, 7, GridBorder::Zero, 0, 6);
  GridSamples samples = samplesOf(params, GridPrecision::Float, GridLayout::Bricked);
  const float before = samples.view().density({2.5, 2.25, 3.75});
  const GridSamples moved = std::move(samples);
  EXPECT_EQ(moved.view().density({2.5, 2.25, 3.75}), before);
}

}  // namespace
}  // namespace pbrtmedia
