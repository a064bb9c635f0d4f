// SPDX-License-Identifier: BSD-2-Clause
#include "main/progress.h"

#include <gtest/gtest.h>

namespace pbrtmedia {
namespace {

TEST(FormatDuration, PicksTheUnitByLength) {
  EXPECT_EQ(formatDuration(0), "0.0s");
  EXPECT_EQ(formatDuration(3.24), "3.2s");
  EXPECT_EQ(formatDuration(59.94), "59.9s");
  EXPECT_EQ(formatDuration(59.97), "1m00s");
  EXPECT_EQ(formatDuration(245), "4m05s");
  EXPECT_EQ(formatDuration(3725), "1h02m");
}

TEST(FormatCount, KeepsThreeDigits) {
  EXPECT_EQ(formatCount(0), "0");
  EXPECT_EQ(formatCount(950), "950");
  EXPECT_EQ(formatCount(12345), "12.3k");
  EXPECT_EQ(formatCount(4.56e6), "4.56M");
  EXPECT_EQ(formatCount(999.6), "1k");
}

}  // namespace
}  // namespace pbrtmedia
