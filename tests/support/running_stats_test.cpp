// SPDX-License-Identifier: BSD-2-Clause
#include "support/running_stats.h"

#include <gtest/gtest.h>

namespace pbrtmedia::test {
namespace {

RunningStats of(std::initializer_list<double> values) {
  RunningStats s;
  for (const double v : values) s.add(v);
  return s;
}

TEST(RunningStats, GivesMeanAndUnbiasedVarianceOfASmallSet) {
  const RunningStats s = of({2, 4, 4, 4, 5, 5, 7, 9});  // sum of squared deviations from 5: 32
  EXPECT_EQ(s.count(), 8u);
  EXPECT_DOUBLE_EQ(s.mean(), 5.0);
  EXPECT_DOUBLE_EQ(s.variance(), 32.0 / 7);
  EXPECT_DOUBLE_EQ(s.standardError(), std::sqrt(32.0 / 7 / 8));
}

TEST(RunningStats, KeepsTheVarianceOfValuesFarFromZero) {
  EXPECT_NEAR(of({1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16}).variance(), 30.0, 1e-6);
}

TEST(RunningStats, HasNoVarianceBelowTwoValues) {
  EXPECT_EQ(RunningStats{}.standardError(), 0.0);
  EXPECT_EQ(of({3}).variance(), 0.0);
}

TEST(RunningStats, JoinsTwoStreamsAsIfTheyWereOne) {
  RunningStats a = of({2, 4, 4}), b = of({4, 5, 5, 7, 9}), empty;
  a.add(b);
  a.add(empty);
  EXPECT_EQ(a.count(), 8u);
  EXPECT_DOUBLE_EQ(a.mean(), 5.0);
  EXPECT_DOUBLE_EQ(a.variance(), 32.0 / 7);
  empty.add(b);
  EXPECT_DOUBLE_EQ(empty.mean(), 6.0);
}

}  // namespace
}  // namespace pbrtmedia::test
