// SPDX-License-Identifier: BSD-2-Clause
#include "main/progress.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pbrtmedia {
namespace {

TEST(FormatDuration, PicksTheUnitByLength) {
  EXPECT_EQ(formatDuration(0), "0.0s");
  EXPECT_EQ(formatDuration(3.24), "3.2s");
  EXPECT_EQ(formatDuration(59.94), "59.9s");
  EXPECT_EQ(formatDuration(59.97), "1m00s");
  EXPECT_EQ(formatDuration(245), "4m05s");
  EXPECT_EQ(formatDuration(3599), "59m59s");
  EXPECT_EQ(formatDuration(3600), "1h00m");
  EXPECT_EQ(formatDuration(3725), "1h02m");
}

TEST(FormatCount, KeepsThreeDigits) {
  EXPECT_EQ(formatCount(0), "0");
  EXPECT_EQ(formatCount(950), "950");
  EXPECT_EQ(formatCount(12345), "12.3k");
  EXPECT_EQ(formatCount(4.56e6), "4.56M");
  EXPECT_EQ(formatCount(999.6), "1k");
}

TEST(LiveLine, ShowsTitleBarAndNumbersWhereThereIsRoom) {
  EXPECT_EQ(liveLine("a.exr", 0.5, " 50%", 80),
            "a.exr [" + std::string(15, '=') + std::string(15, ' ') + "]  50%");
}

TEST(LiveLine, NeverReachesTheLastColumn) {
  const std::string title = "a-very-long-name-of-a-shot-0042_beauty_left_eye.0001.exr";
  const std::string numbers = " 50%  4m05s, 4m05s left, 12.3M samples/s";
  for (int columns = 1; columns <= 200; ++columns) {
    const std::string line = liveLine(title, 0.5, numbers, columns);
    EXPECT_LT(line.size(), static_cast<std::size_t>(std::max(columns, 2))) << columns;
    if (columns < 60) continue;
    EXPECT_NE(line.find(numbers), std::string::npos) << columns;
    EXPECT_EQ(line.substr(0, 4), "a-ve") << columns;
    EXPECT_NE(line.find(".exr"), std::string::npos) << "the end of a name tells frames apart, at " << columns;
  }
  EXPECT_NE(liveLine(title, 0.5, numbers, 200).find(title), std::string::npos);
  EXPECT_EQ(liveLine(title, 0.5, numbers, 60).find('['), std::string::npos) << "no room for a bar";
  EXPECT_NE(liveLine(title, 0.5, numbers, 80).find("[======"), std::string::npos) << "a short bar";
}

TEST(LiveLine, CutsNamesBetweenCharacters) {
  std::string title;
  for (int i = 0; i < 40; ++i) title += "\u00e9";
  for (int columns = 40; columns < 120; ++columns) {
    const std::string line = liveLine(title, 0, " 0%", columns);
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto c = static_cast<unsigned char>(line[i]);
      if (c == 0xc3) {
        ASSERT_LT(i + 1, line.size());
        EXPECT_EQ(static_cast<unsigned char>(line[i + 1]), 0xa9);
        ++i;
      } else {
        EXPECT_LT(c, 0x80) << "half a character at " << columns;
      }
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
