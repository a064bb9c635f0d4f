// SPDX-License-Identifier: BSD-2-Clause
#include "image/image.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "image_helpers.h"

namespace pbrtmedia {
namespace {

namespace fs = std::filesystem;

TEST(Image, StartsBlackWithBothWindowsOnItsPixels) {
  const Image image(3, 2);
  EXPECT_EQ(image.channels(), (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(image.data(), std::vector<float>(18, 0.0f));
  EXPECT_EQ(image.dataWindow, (Bounds2i{{0, 0}, {3, 2}}));
  EXPECT_EQ(image.displayWindow, image.dataWindow);
}

TEST(Image, FindsColoursByChannelName) {
  Image image(1, 1, {"B", "depth", "R", "G"});
  image.data() = {3, 9, 1, 2};
  EXPECT_EQ(image.rgb(0, 0), Rgb(1, 2, 3));
  image.setRgb(0, 0, {4, 5, 6});
  EXPECT_EQ(image.data(), (std::vector<float>{6, 9, 4, 5}));
}

TEST(Image, OneChannelOrYIsGrey) {
  Image depth(1, 1, {"depth"});
  depth.setRgb(0, 0, {1, 2, 6});
  EXPECT_EQ(depth.rgb(0, 0), Rgb(3));
  Image grey(1, 1, {"Y", "A"});
  grey.data() = {0.25f, 1};
  EXPECT_EQ(grey.rgb(0, 0), Rgb(0.25f));
}

TEST(Image, WithoutColourChannelsHasNoRgb) {
  Image image(1, 1, {"R", "G"});
  EXPECT_FALSE(image.hasRgb());
  EXPECT_THROW((void)image.rgb(0, 0), std::logic_error);
  EXPECT_THROW(image.setRgb(0, 0, Rgb(1)), std::logic_error);
}

TEST(Image, RefusesSizesAndChannelsThatMakeNoImage) {
  EXPECT_THROW(Image(-1, 2), std::invalid_argument);
  EXPECT_THROW(Image(1, 1, {}), std::invalid_argument);
  EXPECT_THROW(Image(1, 1, {"R", "R"}), std::invalid_argument);
  EXPECT_THROW(Image(std::numeric_limits<int>::max(), std::numeric_limits<int>::max()),
               std::invalid_argument);
}

TEST(Srgb, EncodesTheValuesOfTheReference) {
  EXPECT_EQ(quantizeSrgb(0.5f), 188);
  EXPECT_EQ(quantizeSrgb(0.18f), 118);
  EXPECT_EQ(quantizeSrgb(1.0f), 255);
  EXPECT_EQ(quantizeSrgb(0.0f), 0);
}

TEST(Srgb, ClampsWhatBytesCannotHold) {
  EXPECT_EQ(quantizeSrgb(-3.0f), 0);
  EXPECT_EQ(quantizeSrgb(7.0f), 255);
  EXPECT_EQ(quantizeSrgb(std::numeric_limits<float>::infinity()), 255);
  EXPECT_EQ(quantizeSrgb(-std::numeric_limits<float>::infinity()), 0);
  EXPECT_EQ(quantizeSrgb(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(Srgb, EveryByteSurvivesDecodingAndEncoding) {
  for (int v = 0; v < 256; ++v) EXPECT_EQ(quantizeSrgb(decodeSrgb(static_cast<float>(v) / 255.0f)), v);
}

TEST(Srgb, CurvesAreInverse) {
  for (float v = -0.1f; v < 3.0f; v += 0.001f) EXPECT_NEAR(decodeSrgb(encodeSrgb(v)), v, 1e-5f * (1 + v));
}

class ImageFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("pbrtmedia_image_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(ImageFiles, AreWrittenByExtensionAndReadByContent) {
  const Image image = patternImage(5, 3);
  for (const char* name : {"a.exr", "b.PFM", "c.png", "d.Tga"}) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(isWritableImageName(name));
    writeImage(folder_ / name, image);
    const Image back = readImage(folder_ / name);
    EXPECT_EQ(back.width(), 5);
    EXPECT_EQ(back.height(), 3);
  }
  // The content decides: an EXR under another name.
  fs::rename(folder_ / "a.exr", folder_ / "a.png");
  EXPECT_EQ(readImage(folder_ / "a.png").data(), image.data());
}

TEST_F(ImageFiles, LeaveNothingElseInTheFolder) {
  writeImage(folder_ / "a.exr", patternImage(2, 2));
  writeImage(folder_ / "a.exr", patternImage(3, 3));
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_)) ++count;
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(readImage(folder_ / "a.exr").width(), 3);
}

TEST_F(ImageFiles, UnknownExtensionsAreRefusedByNameAndList) {
  EXPECT_FALSE(isWritableImageName("a.jpg"));
  EXPECT_FALSE(isWritableImageName("exr"));
  try {
    writeImage(folder_ / "a.jpg", patternImage(2, 2));
    FAIL() << "written";
  } catch (const std::runtime_error& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("a.jpg"), std::string::npos) << what;
    EXPECT_NE(what.find(".exr, .pfm, .png, .tga"), std::string::npos) << what;
  }
}

TEST_F(ImageFiles, ThatCannotBeWrittenAreNamed) {
  const fs::path path = folder_ / "missing" / "a.exr";
  try {
    writeImage(path, patternImage(2, 2));
    FAIL() << "written";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find(path.filename().string()), std::string::npos) << e.what();
  }
  EXPECT_THROW(writeImage(folder_ / "empty.exr", Image(0, 0)), std::runtime_error);
}

TEST_F(ImageFiles, ThatAreNoImagesAreNamed) {
  std::ofstream(folder_ / "notes.txt") << "not an image";
  std::ofstream(folder_ / "empty.png").flush();
  for (const char* name : {"notes.txt", "empty.png", "missing.exr"}) {
    SCOPED_TRACE(name);
    try {
      readImage(folder_ / name);
      FAIL() << "read";
    } catch (const SceneError& e) {
      ASSERT_TRUE(e.location().file);
      EXPECT_NE(e.location().file->find(name), std::string::npos) << *e.location().file;
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
