// SPDX-License-Identifier: BSD-2-Clause
#include "base/frame_names.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

TEST(FrameNames, FillsEveryPlace) {
  EXPECT_EQ(frameName("smoke.%04d.vdb", 7), "smoke.0007.vdb");
  EXPECT_EQ(frameName("smoke.%04d.vdb", 12345), "smoke.12345.vdb");
  EXPECT_EQ(frameName("%d/s%3d", 4), "4/s  4");
  EXPECT_EQ(frameName("100%%-%02d", 3), "100%-03");
  EXPECT_EQ(frameName("50% off %s.vdb", 3), "50% off %s.vdb");
}

TEST(FrameNames, FillsThePlacesOfHoudiniAndBlender) {
  EXPECT_EQ(frameName("smoke.$F4.vdb", 7), "smoke.0007.vdb");
  EXPECT_EQ(frameName("$F/smoke_$F.vdb", 12), "12/smoke_12.vdb");
  EXPECT_EQ(frameName("${F3}a.vdb", 7), "007a.vdb");
  EXPECT_EQ(frameName("${F}.vdb", 7), "7.vdb");
  EXPECT_EQ(frameName("fluid_data_####.vdb", 7), "fluid_data_0007.vdb");
  EXPECT_EQ(frameName("a#b##.vdb", 123), "a123b123.vdb");
}

TEST(FrameNames, KnowsWhatIsNoPlace) {
  for (const char* name : {"a.vdb", "%", "%%d", "%s", "%4", "%-4d", "%1234d", "% d", "$", "$f4", "$FF",
                           "$FPS", "$F4a", "${F", "${Fx}", "$F123"}) {
    EXPECT_FALSE(hasFramePlace(name)) << name;
    EXPECT_EQ(frameName(name, 1), name);
  }
  for (const char* name : {"%d", "%%%d", "a%4db", "%04d", "$F", "$F4", "$F4.vdb", "${F4}", "#", "a####"})
    EXPECT_TRUE(hasFramePlace(name)) << name;
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
  ASSERT_TRUE(parseFrameRange("3:9"));
  EXPECT_EQ(parseFrameRange("3:9")->first, 3);
  EXPECT_EQ(parseFrameRange("3:9")->last, 9);
  for (const char* text : {"3-9:2", "3:9:2", "3-9x2"}) {
    ASSERT_TRUE(parseFrameRange(text)) << text;
    EXPECT_EQ(parseFrameRange(text)->last, 9) << text;
    EXPECT_EQ(parseFrameRange(text)->step, 2) << text;
  }
  ASSERT_TRUE(parseFrameRange("0012"));
  EXPECT_EQ(parseFrameRange("0012")->last, 12);
  for (const char* text : {"", "-", "1-", "5-4", "1-2:0", "1-2:", "1-2-3", "x", "1 - 2", "99999999999", "5:4",
                           "1:2:3:4", "1x2"}) {
    EXPECT_FALSE(parseFrameRange(text)) << text;
  }
}

TEST(FrameNames, ListsTheFramesThatAreThere) {
  TemporaryFolder folder;
  for (const char* name : {"s.0008.vdb", "s.0010.vdb", "s.12345.vdb", "s.9.vdb", "s.0011.pbrt", "t.0001.vdb",
                           "s7.vdb", "12-a-0012.vdb", "13-a-0012.vdb", "5%.vdb"}) {
    folder.write(name, "");
  }
  std::filesystem::create_directory(folder.path() / "0003");
  folder.write("0003/s.vdb", "");
  const auto found = [&](const std::string& name) {
    return framesThatExist((folder.path() / name).string());
  };
  EXPECT_EQ(found("s.%04d.vdb"), (std::vector{8, 10, 12345}));
  EXPECT_EQ(found("s.$F4.vdb"), (std::vector{8, 10, 12345}));
  EXPECT_EQ(found("s.####.vdb"), (std::vector{8, 10, 12345}));
  EXPECT_EQ(found("s.$F.vdb"), (std::vector{9, 12345}));
  EXPECT_EQ(found("s#.vdb"), (std::vector{7}));
  EXPECT_EQ(found("#-a-####.vdb"), (std::vector{12})) << "every place holds the same number";
  EXPECT_EQ(found("####/s.vdb"), (std::vector{3}));
  EXPECT_EQ(found("#%%.vdb"), (std::vector{5}));
  EXPECT_EQ(found("u.%04d.vdb"), std::vector<int>());
  EXPECT_EQ(found("s.0008.vdb"), std::vector<int>()) << "no place";
  EXPECT_EQ(framesThatExist("no/such/folder/s.#.vdb"), std::vector<int>());
}

}  // namespace
}  // namespace pbrtmedia
