// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/progress_line.h"

#include <gtest/gtest.h>

#include <sstream>

namespace pbrtmedia {
namespace {

class VdbProgress : public testing::Test {
 protected:
  ProgressLine line(int columns) {
    return ProgressLine(out_, columns, [this] { return now_; });
  }
  void pass(int milliseconds) { now_ += std::chrono::milliseconds(milliseconds); }

  std::ostringstream out_;
  std::chrono::steady_clock::time_point now_;
};

TEST_F(VdbProgress, IsOneLineOnATerminalAndNeverWider) {
  ProgressLine l = line(24);
  l.update("reading", 0.25);
  EXPECT_EQ(out_.str(), "") << "not at once";
  pass(101);
  l.update("reading", 0.25);
  EXPECT_EQ(out_.str(), "\rvdb2pbrt: reading 25%\033[K");
  pass(50);
  l.update("reading", 0.5);
  EXPECT_EQ(out_.str(), "\rvdb2pbrt: reading 25%\033[K") << "not too often";
  out_.str("");
  pass(51);
  l.update("writing a long name", -1);
  EXPECT_EQ(out_.str(), "\rvdb2pbrt: writing a lon\033[K") << "23 of 24 columns";
  out_.str("");
  l.clear();
  l.clear();
  EXPECT_EQ(out_.str(), "\r\033[K");
}

TEST_F(VdbProgress, IsALineNowAndThenElsewhere) {
  ProgressLine l = line(0);
  for (int i = 0; i < 12; ++i) {
    l.update("frame " + std::to_string(i), -1);
    pass(1000);
  }
  l.clear();
  EXPECT_EQ(out_.str(), "vdb2pbrt: frame 5\nvdb2pbrt: frame 10\n");
}

}  // namespace
}  // namespace pbrtmedia
