// SPDX-License-Identifier: BSD-2-Clause
#include "support/z_test.h"

#include <gtest/gtest.h>

#include <sstream>

namespace pbrtmedia::test {
namespace {

double uniform(Rng& rng) { return rng.uniformDouble(); }

TEST(ZTest, TwoSidedPValuesMatchTheNormalTable) {
  EXPECT_NEAR(twoSidedPValue(1.959963985), 0.05, 1e-9);
  EXPECT_NEAR(twoSidedPValue(-2.575829304), 0.01, 1e-9);
  EXPECT_NEAR(twoSidedPValue(kMaxAbsZ), 5.733e-7, 1e-10);
}

// The harness itself: of good runs it rejects the share it promises. 4000 runs: standard error 0.34 %.
TEST(ZTest, RejectsFivePercentOfGoodRunsAtFivePercent) {
  int rejected = 0;
  constexpr int kRuns = 4000;
  for (int run = 0; run < kRuns; ++run)
    rejected += runZTest(uniform, 0.5, static_cast<std::uint64_t>(run), 400).pValue() < 0.05;
  const double z = (rejected - 0.05 * kRuns) / std::sqrt(0.05 * 0.95 * kRuns);
  EXPECT_LT(std::abs(z), kMaxAbsZ) << rejected << " of " << kRuns << " rejected";
}

TEST(ZTest, RejectsABiasOfTwelveStandardErrorsInEitherDirection) {
  constexpr std::uint64_t kN = 1 << 16;
  const double bias = 12 * std::sqrt(1.0 / 12 / kN);
  for (const double sign : {-1.0, 1.0}) {
    const ZTest test = runZTest([&](Rng& rng) { return uniform(rng) + sign * bias; }, 0.5, 1, kN);
    EXPECT_GT(sign * test.z(), kMaxAbsZ) << test;
  }
}

TEST(ZTest, TwoEstimatesOfOneMeanAgreeAndOfTwoDoNot) {
  Rng rng(3);
  RunningStats a, b, c;
  for (int i = 0; i < 10000; ++i) {
    a.add(uniform(rng));
    b.add(2 * uniform(rng) - 0.5);
    c.add(uniform(rng) + 0.1);
  }
  EXPECT_LT(std::abs(zTest(a, b).z()), kMaxAbsZ) << zTest(a, b);
  EXPECT_GT(std::abs(zTest(a, c).z()), kMaxAbsZ) << zTest(a, c);
}

TEST(ZTest, WithoutSpreadAcceptsOnlyTheTruth) {
  EXPECT_EQ(runZTest([](Rng&) { return 2.0; }, 2.0, 1, 100).z(), 0.0);
  EXPECT_GT(runZTest([](Rng&) { return 2.1; }, 2.0, 1, 100).z(), 1e300);
  EXPECT_LT(runZTest([](Rng&) { return 1.9; }, 2.0, 1, 100).z(), -1e300);
}

TEST(ZTest, NeverAcceptsNotANumber) {
  const ZTest test = runZTest([](Rng&) { return std::nan(""); }, 0.5, 1, 10);
  EXPECT_FALSE(std::abs(test.z()) < kMaxAbsZ);
  EXPECT_FALSE(std::abs(ZTest{.mean = std::nan("")}.z()) < kMaxAbsZ);
}

TEST(ZTest, PrintsEveryNumber) {
  std::ostringstream os;
  os << ZTest{.mean = 1.5, .truth = 1, .standardError = 0.25, .truthStandardError = 0, .seed = 7, .n = 9};
  EXPECT_EQ(os.str(), "mean 1.5, truth 1, standard error 0.25 (of truth 0), z 2, seed 7, n 9");
}

}  // namespace
}  // namespace pbrtmedia::test
