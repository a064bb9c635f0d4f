// SPDX-License-Identifier: BSD-2-Clause
#include "textures/checkerboard.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"
#include "textures/dots.h"
#include "textures/texture_test_support.h"

namespace pbrtmedia {
namespace {

using test::atPoint;
using test::atUv;

const ConstantTexture<float> kOne(1), kTwo(2);

TEST(Checkerboard2dTexture, AlternatesFromTheFirstTextureAtTheOrigin) {
  const Checkerboard2dTexture<float> board(UvMapping{}, kOne, kTwo, CheckerboardFilter::None);
  EXPECT_EQ(board.evaluate(atUv(0.5f, 0.5f)), 1);
  EXPECT_EQ(board.evaluate(atUv(1.5f, 0.5f)), 2);
  EXPECT_EQ(board.evaluate(atUv(1.5f, 1.5f)), 1);
  EXPECT_EQ(board.evaluate(atUv(-0.5f, 0.5f)), 2);
  EXPECT_EQ(board.evaluate(atUv(-0.5f, -1.5f)), 2);
  EXPECT_EQ(board.evaluate(atUv(2, 3)), 2);
  EXPECT_EQ(board.evaluate(atUv(-3e9f, 4e9f)), 1);  // large coordinates are even integers
}

TEST(Checkerboard2dTexture, BlendsByTheShareUnderTheFootprint) {
  const Checkerboard2dTexture<float> board(UvMapping{}, kOne, kTwo);
  SurfaceInteraction si = atUv(1, 0.5f);
  si.dudx = 0.25f;
  si.dvdy = 0.25f;
  EXPECT_FLOAT_EQ(board.evaluate(si), 1.5f);
  si.uv = {0.75f, 0.5f};
  si.dudx = 0.5f;  // [0.25, 1.25]: a quarter in the second
  EXPECT_FLOAT_EQ(board.evaluate(si), 1.25f);
  si.dudx = 0.1f;  // within one check
  EXPECT_EQ(board.evaluate(si), 1);
}

TEST(CheckerboardShare, IsOneHalfUnderWideFootprints) {
  EXPECT_EQ(checkerboardShare({{0.3f, 0.4f}, {1.01f, 0}, {0, 0}}, CheckerboardFilter::ClosedForm), 0.5f);
  EXPECT_EQ(checkerboardShare({{0.3f, 0.4f}, {0, 0}, {0, -30}}, CheckerboardFilter::ClosedForm), 0.5f);
  EXPECT_EQ(checkerboardShare({{0.3f, 0.4f}, {0, 0}, {0, -30}}, CheckerboardFilter::None), 0);
}

TEST(CheckerboardShare, IsDefinedForAFootprintAlongOneAxisOnly) {
  EXPECT_FLOAT_EQ(checkerboardShare({{1.5f, 1}, {0, 0.5f}, {0, 0}}, CheckerboardFilter::ClosedForm), 0.5f);
  EXPECT_FLOAT_EQ(checkerboardShare({{1.5f, 0.75f}, {0, 0.5f}, {0, 0}}, CheckerboardFilter::ClosedForm),
                  0.75f);
}

TEST(CheckerboardShare, EqualsTheBoxAverageByBruteForce) {
  Rng rng(11);
  constexpr int kGrid = 600;
  // A box at most two checks wide meets at most three lines per axis; each misplaces half a row at most.
  constexpr float kTolerance = 6 * 0.5f / kGrid + 1e-4f;
  for (int i = 0; i < 40; ++i) {
    const Point2f st{10 * rng.uniform() - 5, 10 * rng.uniform() - 5};
    const Vector2f half{rng.uniform(), rng.uniform()};
    int odd = 0;
    for (int y = 0; y < kGrid; ++y) {
      for (int x = 0; x < kGrid; ++x) {
        const float s = st.x + half.x * ((static_cast<float>(x) + 0.5f) * 2 / kGrid - 1);
        const float t = st.y + half.y * ((static_cast<float>(y) + 0.5f) * 2 / kGrid - 1);
        odd += (static_cast<int>(std::floor(s)) + static_cast<int>(std::floor(t))) % 2 != 0 ? 1 : 0;
      }
    }
    const float share = checkerboardShare({st, {half.x, 0}, {0, -half.y}}, CheckerboardFilter::ClosedForm);
    EXPECT_NEAR(share, static_cast<float>(odd) / (kGrid * kGrid), kTolerance) << st << half;
  }
}

TEST(Checkerboard3dTexture, AlternatesOnAllThreeAxesAndIsNeverFiltered) {
  const Checkerboard3dTexture<float> board(Mapping3d{}, kOne, kTwo);
  EXPECT_EQ(board.evaluate(atPoint({0.5f, 0.5f, 0.5f})), 1);
  EXPECT_EQ(board.evaluate(atPoint({1.5f, 0.5f, 0.5f})), 2);
  EXPECT_EQ(board.evaluate(atPoint({1.5f, 1.5f, 0.5f})), 1);
  EXPECT_EQ(board.evaluate(atPoint({1.5f, 1.5f, 1.5f})), 2);
  EXPECT_EQ(board.evaluate(atPoint({-0.5f, 0.5f, 0.5f})), 2);
  EXPECT_EQ(board.evaluate(atPoint({-0.5f, -0.5f, -0.5f})), 2);
  SurfaceInteraction si = atPoint({0.9f, 0.5f, 0.5f});
  si.dpdx = {5, 5, 5};
  EXPECT_EQ(board.evaluate(si), 1);
}

TEST(DotsTexture, ShowsInsideOutsideTheDotsAsPbrtDoes) {
  // Cell (2, 3) has a dot around (2.050922, 2.901082), cell (0, 0) has none; computed outside from 14.2.
  const DotsTexture<float> dots(UvMapping{}, kOne, kTwo);
  EXPECT_EQ(dots.evaluate(atUv(2.050922f, 2.901082f)), 2);
  EXPECT_EQ(dots.evaluate(atUv(2.050922f + 0.349f, 2.901082f)), 2);
  EXPECT_EQ(dots.evaluate(atUv(2.050922f + 0.351f, 2.901082f)), 1);
  EXPECT_EQ(dots.evaluate(atUv(2.050922f, 2.901082f - 0.351f)), 1);
  EXPECT_EQ(dots.evaluate(atUv(0, 0)), 1);
}

TEST(DotsTexture, NeverCutsADotAtItsCellEdge) {
  for (int i = 0; i < 1000; ++i) {
    const float along = static_cast<float>(i) * 0.0371f;
    EXPECT_FALSE(isInsideDot({static_cast<float>(i % 17) + 0.5f, along}));
    EXPECT_FALSE(isInsideDot({along, static_cast<float>(i % 13) - 0.5f}));
  }
}

}  // namespace
}  // namespace pbrtmedia
