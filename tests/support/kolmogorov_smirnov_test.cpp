// SPDX-License-Identifier: BSD-2-Clause
#include "support/kolmogorov_smirnov.h"

#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/chi_square.h"
#include "support/z_test.h"

namespace pbrtmedia::test {
namespace {

std::vector<double> powers(double exponent, std::size_t n, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<double> v(n);
  for (double& x : v) x = std::pow(rng.uniformDouble(), exponent);
  return v;
}

TEST(KolmogorovSmirnov, FindsTheLargestDistanceOnEitherSideOfAStep) {
  EXPECT_DOUBLE_EQ(ksTestUniform({0.5}).distance, 0.5);
  EXPECT_DOUBLE_EQ(ksTestUniform({0.75, 0.25}).distance, 0.25);
  EXPECT_DOUBLE_EQ(ksTestUniform({0.9, 0.8}).distance, 0.8);
  EXPECT_DOUBLE_EQ(ksTestUniform({0.1, 0.2}).distance, 0.8);
}

TEST(KolmogorovSmirnov, MatchesTheTableOfCriticalValues) {
  EXPECT_NEAR((KsTest{0.13403, 100}.pValue()), 0.05, 0.002);  // exact 5 % point for n = 100
  EXPECT_NEAR((KsTest{0.40925, 10}.pValue()), 0.05, 0.003);   // and n = 10
  EXPECT_EQ((KsTest{0.0, 100}.pValue()), 1.0);
  EXPECT_LT((KsTest{1.0, 100}.pValue()), 1e-80);
}

TEST(KolmogorovSmirnov, RejectsFivePercentOfGoodRunsAtFivePercent) {
  constexpr int kRuns = 3000;
  int rejected = 0;
  for (int run = 0; run < kRuns; ++run) {
    const KsTest test =
        ksTest(powers(0.5, 500, static_cast<std::uint64_t>(run)), [](double x) { return x * x; });
    rejected += test.pValue() < 0.05;
  }
  const double z = (rejected - 0.05 * kRuns) / std::sqrt(0.05 * 0.95 * kRuns);
  EXPECT_LT(std::abs(z), kMaxAbsZ) << rejected << " of " << kRuns << " rejected";
}

TEST(KolmogorovSmirnov, RejectsAWrongDistribution) {
  const KsTest test = ksTestUniform(powers(1.1, 10000, 1));
  EXPECT_LT(test.pValue(), kMinPValue) << test;
}

TEST(KolmogorovSmirnov, NeverAcceptsNotANumber) {
  EXPECT_EQ(ksTestUniform({0.1, std::nan(""), 0.9}).pValue(), 0.0);
  EXPECT_EQ(ksTest({0.1}, [](double) { return std::nan(""); }).pValue(), 0.0);
}

}  // namespace
}  // namespace pbrtmedia::test
