// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/running_product.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pbrtmedia {
namespace {

TEST(RunningProduct, IsAnOrdinaryProductInTheRangeOfDouble) {
  RunningProduct p(-2);
  for (const double factor : {3., -.25, 7., 1e100, 1e-100}) p.multiply(factor);
  EXPECT_NEAR(p.product(), -5.25, 1e-14);
  EXPECT_NEAR(p.magnitude(), 5.25, 1e-14);
  EXPECT_NEAR(p.value(), -5.25 * std::exp(-2), 1e-14);
  EXPECT_NEAR(p.timesExp(-1), -5.25 * std::exp(-3), 1e-14);
  EXPECT_NEAR(p.logMagnitude(), std::log(5.25), 1e-14);
  EXPECT_NEAR(std::ldexp(p.mantissa(), static_cast<int>(p.exponent())), -5.25, 1e-14);
}

TEST(RunningProduct, KeepsAPoissonProbabilityWhoseEveryPartLeavesTheRangeOfDouble) {
  for (const double mean : {700., 740., 1e4, 1e6}) {
    RunningProduct p(-mean);
    for (double k = 1; k <= mean; ++k) p.multiply(mean / k);
    const double stirling = std::exp(-1 / (12 * mean)) / std::sqrt(2 * 3.14159265358979323846 * mean);
    EXPECT_NEAR(p.value(), stirling, 1e-9 * stirling) << mean;
  }
}

TEST(RunningProduct, IsRightDownToTheSmallestDoubles) {
  RunningProduct p(-744);
  for (int i = 0; i < 150; ++i) p.multiply(2);
  EXPECT_NEAR(p.value(), std::exp(150 * std::log(2) - 744), 1e-10 * p.value());
  p = RunningProduct(-700);
  for (int i = 0; i < 20; ++i) p.multiply(10);
  EXPECT_NEAR(p.value(), std::exp(20 * std::log(10) - 700), 1e-10 * p.value());
}

TEST(RunningProduct, IsInfiniteOrZeroBeyondAndNeverNotANumber) {
  RunningProduct p;
  for (int i = 0; i < 2000; ++i) p.multiply(-9);
  EXPECT_EQ(p.product(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(p.timesExp(0), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(p.timesExp(-2000 * std::log(9)), 1, 1e-9);
  p.multiply(0);
  EXPECT_TRUE(p.isZero());
  EXPECT_EQ(p.product(), 0);
  EXPECT_EQ(p.value(), 0);
  EXPECT_EQ(p.timesExp(-3), 0);
  EXPECT_EQ(p.logMagnitude(), -std::numeric_limits<double>::infinity());
  RunningProduct small;
  for (int i = 0; i < 2000; ++i) small.multiply(.5);
  EXPECT_EQ(small.magnitude(), 0);
  EXPECT_FALSE(small.isZero());
  for (int i = 0; i < 2000; ++i) small.multiply(2);
  EXPECT_EQ(small.product(), 1);
}

TEST(RunningProduct, SumsOfInfiniteTermsOfBothSignsStayInfinite) {
  double sum = 1;
  addTerm(sum, 2);
  EXPECT_EQ(sum, 3);
  const double infinity = std::numeric_limits<double>::infinity();
  addTerm(sum, -infinity);
  addTerm(sum, infinity);
  EXPECT_EQ(sum, -infinity);
}

}  // namespace
}  // namespace pbrtmedia
