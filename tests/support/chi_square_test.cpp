// SPDX-License-Identifier: BSD-2-Clause
#include "support/chi_square.h"

#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/z_test.h"

namespace pbrtmedia::test {
namespace {

std::vector<double> histogram(std::span<const double> cdf, int n, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<double> counts(cdf.size());
  for (int i = 0; i < n; ++i) {
    const double u = rng.uniformDouble();
    ++counts[static_cast<std::size_t>(std::upper_bound(cdf.begin(), cdf.end() - 1, u) - cdf.begin())];
  }
  return counts;
}

TEST(GammaQ, MatchesClosedFormsOnBothSidesOfTheSplit) {
  for (const double x : {0.01, 0.5, 1.0, 2.0, 5.0, 30.0}) {
    EXPECT_NEAR(gammaQ(1, x), std::exp(-x), 1e-13);                        // exponential
    EXPECT_NEAR(gammaQ(0.5, x), std::erfc(std::sqrt(x)), 1e-13);           // half-normal
    EXPECT_NEAR(gammaQ(3, x), std::exp(-x) * (1 + x + x * x / 2), 1e-13);  // Erlang
  }
  EXPECT_EQ(gammaQ(2, 0), 1.0);
  EXPECT_NEAR(gammaQ(500, 500), 0.5, 0.01);  // the median lies a third below the mean
}

TEST(Sidak, GivesBackTheCommonLevel) {
  const double each = sidak(0.05, 20);
  EXPECT_NEAR(1 - std::pow(1 - each, 20), 0.05, 1e-14);
  EXPECT_EQ(sidak(0.05, 1), 0.05);
  EXPECT_NEAR(sidak(kMinPValue, 1000) * 1000 / kMinPValue, 1.0, 1e-6);  // no cancellation at tiny levels
}

TEST(ChiSquare, GivesPearsonsStatistic) {
  const std::vector<double> observed{10, 20, 30}, expected{20, 20, 20};
  const ChiSquareTest test = chiSquareTest(observed, expected);
  EXPECT_DOUBLE_EQ(test.statistic, 10.0);
  EXPECT_EQ(test.degreesOfFreedom, 2u);
  EXPECT_NEAR(test.pValue(), std::exp(-5.0), 1e-12) << test;
}

TEST(ChiSquare, PoolsSmallExpectationsAndThrowsNoneAway) {
  // 1 + 2 + 3 make a pool of 6; 5 and 20 stand alone.
  const std::vector<double> observed{4, 0, 20, 1, 6}, expected{1, 3, 20, 2, 5};
  const ChiSquareTest test = chiSquareTest(observed, expected);
  EXPECT_DOUBLE_EQ(test.statistic, 1.0 / 6 + 1.0 / 5);
  EXPECT_EQ(test.degreesOfFreedom, 2u);
  EXPECT_EQ(test.pooledBins, 3u);
  EXPECT_EQ(test.observedTotal, 31.0);
  EXPECT_EQ(test.expectedTotal, 31.0);
}

TEST(ChiSquare, RefusesCountsWhereNothingIsExpected) {
  EXPECT_EQ(chiSquareTest(std::vector<double>{1, 99, 100}, std::vector<double>{0, 100, 100}).pValue(), 0.0);
  EXPECT_EQ(chiSquareTest(std::vector<double>{1, 99}, std::vector<double>{std::nan(""), 100}).pValue(), 0.0);
}

TEST(ChiSquare, RefusesToRunWhereItCouldNotFail) {
  EXPECT_THROW(chiSquareTest(std::vector<double>{1, 1}, std::vector<double>{1, 1}), std::invalid_argument);
  EXPECT_THROW(chiSquareTest(std::vector<double>{9}, std::vector<double>{9}), std::invalid_argument);
  EXPECT_THROW(chiSquareTest(std::vector<double>{9, 9}, std::vector<double>{9}), std::invalid_argument);
}

TEST(ChiSquare, RejectsFivePercentOfGoodRunsAtFivePercent) {
  std::vector<double> cdf(20), expected(20);
  for (std::size_t i = 0; i < 20; ++i) cdf[i] = std::pow((i + 1.0) / 20, 1.5);
  constexpr int kN = 2000, kRuns = 3000;
  for (std::size_t i = 0; i < 20; ++i) expected[i] = kN * (cdf[i] - (i ? cdf[i - 1] : 0));
  int rejected = 0;
  for (int run = 0; run < kRuns; ++run)
    rejected += chiSquareTest(histogram(cdf, kN, static_cast<std::uint64_t>(run)), expected).pValue() < 0.05;
  const double z = (rejected - 0.05 * kRuns) / std::sqrt(0.05 * 0.95 * kRuns);
  EXPECT_LT(std::abs(z), kMaxAbsZ) << rejected << " of " << kRuns << " rejected";
}

TEST(ChiSquare, RejectsAWrongDistribution) {
  std::vector<double> cdf(20);
  for (std::size_t i = 0; i < 20; ++i) cdf[i] = std::pow((i + 1.0) / 20, 1.1);
  const ChiSquareTest test = chiSquareUniform(histogram(cdf, 20000, 1));
  EXPECT_LT(test.pValue(), kMinPValue) << test;
}

}  // namespace
}  // namespace pbrtmedia::test
