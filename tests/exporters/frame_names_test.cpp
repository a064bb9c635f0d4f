// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/frame_names.h"

#include <gtest/gtest.h>

namespace pbrtmedia {
namespace {

TEST(FrameNames, FillsEveryPlace) {
  EXPECT_EQ(frameName("smoke.%04d.vdb", 7), "smoke.0007.vdb");
  EXPECT_EQ(frameName("smoke.%04d.vdb", 12345), "smoke.12345.vdb");
  EXPECT_EQ(frameName("%d/s%3d", 4), "4/s  4");
  EXPECT_EQ(frameName("100%%-%02d", 3), "100%-03");
  EXPECT_EQ(frameName("50% off %s.vdb", 3), "50% off %s.vdb");
}

TEST(FrameNames, KnowsWhatIsNoPlace) {
  for (const char* name : {"a.vdb", "%", "%%d", "%s", "%4", "%-4d", "%1234d", "% d"}) {
    EXPECT_FALSE(hasFramePlace(name)) << name;
    EXPECT_EQ(frameName(name, 1), name);
  }
  for (const char* name : {"%d", "%%%d", "a%4db", "%04d"}) EXPECT_TRUE(hasFramePlace(name)) << name;
}

TEST(FrameNames, ReadsRanges) {
  const auto all = parseFrameRange("1-24");
  ASSERT_TRUE(all);
  EXPECT_EQ(all->first, 1);
  EXPECT_EQ(all->last, 24);
  EXPECT_EQ(all->step, 1);
  const auto third = parseFrameRange("10-20:3");
  ASSERT_TRUE(third);
  EXPECT_EQ(third->step, 3);
  ASSERT_TRUE(parseFrameRange("0012"));
  EXPECT_EQ(parseFrameRange("0012")->last, 12);
  for (const char* text : {"", "-", "1-", "5-4", "1-2:0", "1-2:", "1-2-3", "x", "1 - 2", "99999999999"}) {
    EXPECT_FALSE(parseFrameRange(text)) << text;
  }
}

}  // namespace
}  // namespace pbrtmedia
