// SPDX-License-Identifier: BSD-2-Clause
#include "base/math.h"

#include <gtest/gtest.h>

namespace pbrtmedia {
namespace {

TEST(Math, OneMinusEpsilonIsTheFloatBelowOne) { EXPECT_EQ(std::nextafter(kOneMinusEpsilon, 2.0f), 1.0f); }

TEST(Math, LerpMeetsBothEndsExactly) {
  EXPECT_EQ(lerp(0.0f, 0.1f, 0.7f), 0.1f);
  EXPECT_EQ(lerp(1.0f, 0.1f, 0.7f), 0.7f);
  EXPECT_EQ(lerp(0.25, 8.0, 16.0), 10.0);
}

TEST(Math, ConvertsAngles) {
  EXPECT_DOUBLE_EQ(radians(180.0), std::numbers::pi);
  EXPECT_DOUBLE_EQ(degrees(radians(37.5)), 37.5);
}

TEST(Math, SafeSquareRootAbsorbsRoundingLeftovers) {
  EXPECT_EQ(safeSqrt(-1e-7f), 0.0f);
  EXPECT_EQ(safeSqrt(4.0f), 2.0f);
}

struct Roots {
  bool found;
  double t0 = -99, t1 = -99;
};
Roots solve(double a, double b, double c) {
  Roots r{};
  r.t0 = r.t1 = -99;
  r.found = solveQuadratic(a, b, c, r.t0, r.t1);
  return r;
}

TEST(SolveQuadratic, FindsIntegerRootsInOrderForEitherSignOfA) {
  for (const double sign : {1.0, -1.0}) {
    const Roots r = solve(sign * 2, sign * -6, sign * -20);  // 2 (t - 5)(t + 2)
    ASSERT_TRUE(r.found);
    EXPECT_EQ(r.t0, -2.0);
    EXPECT_EQ(r.t1, 5.0);
  }
}

TEST(SolveQuadratic, TellsThatThereIsNoRealRoot) {
  EXPECT_FALSE(solve(1, 0, 1).found);
  EXPECT_FALSE(solve(1, 2, 1.0000001).found);
}

TEST(SolveQuadratic, FindsADoubleRootTwice) {
  const Roots r = solve(1, -6, 9);
  ASSERT_TRUE(r.found);
  EXPECT_EQ(r.t0, 3.0);
  EXPECT_EQ(r.t1, 3.0);
  const Roots zero = solve(3, 0, 0);
  ASSERT_TRUE(zero.found);
  EXPECT_EQ(zero.t0, 0.0);
  EXPECT_EQ(zero.t1, 0.0);
}

TEST(SolveQuadratic, SolvesALinearEquation) {
  const Roots r = solve(0, 4, -2);
  ASSERT_TRUE(r.found);
  EXPECT_EQ(r.t0, 0.5);
  EXPECT_EQ(r.t1, 0.5);
  EXPECT_FALSE(solve(0, 0, 1).found);
}

TEST(SolveQuadratic, DoesNotCancelWhenOneRootIsTiny) {
  // (t - 1e-9)(t - 1e9): the textbook formula loses every digit of the small root.
  const Roots r = solve(1, -(1e9 + 1e-9), 1);
  ASSERT_TRUE(r.found);
  EXPECT_NEAR(r.t0 / 1e-9, 1, 1e-15);
  EXPECT_NEAR(r.t1 / 1e9, 1, 1e-15);
}

TEST(SolveQuadratic, KeepsTheDigitsOfNearlyEqualRoots) {
  // Roots 1 and 1 + 2^-26: b^2 - 4ac is 2^-52, below the rounding error of b^2.
  const double e = 0x1p-26;
  const Roots r = solve(1, -(2 + e), 1 + e);
  ASSERT_TRUE(r.found);
  EXPECT_NEAR(r.t1 - r.t0, e, e * 1e-6);
  EXPECT_NEAR(r.t0, 1, 1e-15);
}

}  // namespace
}  // namespace pbrtmedia
