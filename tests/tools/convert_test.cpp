// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <stdexcept>

#include "tools/imgtool/convert.h"

namespace pbrtmedia {
namespace {

Image greys(int width, int height, std::vector<float> values) {
  Image image(width, height, {"Y"});
  image.data() = std::move(values);
  image.metadata = {{"samples", "4"}, {"seed", "1"}, {"command", "pbrt"}};
  return image;
}

TEST(Convert, WithoutOptionsChangesNothing) {
  const Image image = greys(2, 1, {1, 2});
  const Image out = converted(image, {});
  EXPECT_EQ(out.data(), image.data());
  EXPECT_EQ(out.metadata, image.metadata);
}

TEST(Convert, ScaleAndExposureMultiply) {
  EXPECT_EQ(converted(greys(1, 1, {3}), {.scale = 0.5f, .exposure = 2.0f}).data()[0], 6);
  EXPECT_THROW(converted(greys(1, 1, {3}), {.exposure = 1000.0f}), std::runtime_error);
}

TEST(Convert, CropsBeforeEverythingElse) {
  const Image out = converted(greys(3, 1, {1, 2, 1000}), {.crop = {0, 2, 0, 1}, .resize = "1x1"});
  EXPECT_EQ(out.data(), std::vector<float>{1.5f});
}

TEST(Convert, ScalesBeforeToneMapping) {
  // 2 * 1.5 = 3 with Ymax = 3 becomes 1.
  const Image out = converted(greys(1, 1, {1.5f}), {.scale = 2.0f, .toneMap = true, .maxLuminance = 3});
  EXPECT_NEAR(out.data()[0], 1, 1e-6f);
}

TEST(Convert, RepeatsBeforeItFlips) {
  const Image out = converted(greys(1, 2, {1, 2}), {.repeatPixels = 2, .flipY = true});
  EXPECT_EQ(out.data(), (std::vector<float>{2, 2, 2, 2, 1, 1, 1, 1}));
}

TEST(Convert, DropsSamplesAndSeedOnceValuesChange) {
  const Image scaled = converted(greys(1, 1, {3}), {.scale = 2.0f});
  EXPECT_EQ(scaled.metadata, (std::map<std::string, std::string>{{"command", "pbrt"}}));
  const Image cropped = converted(greys(2, 1, {3, 4}), {.crop = {1, 2, 0, 1}});
  EXPECT_EQ(cropped.metadata.at("samples"), "4");
}

TEST(Convert, ShowsSignedValuesByTheScale) {
  const Image half = converted(greys(2, 1, {-1, 4}), {.scale = 0.25f, .isSigned = true});
  EXPECT_EQ(half.rgb(1, 0), Rgb(1, 0, 0));
  EXPECT_EQ(half.rgb(0, 0).b, 1);
  EXPECT_GT(half.rgb(0, 0).r, 0.4f) << "a quarter of the way to blue";
  const Image whole = converted(greys(2, 1, {-4, 2}), {.isSigned = true, .zero = ZeroColor::Black});
  EXPECT_EQ(whole.rgb(0, 0), Rgb(0, 0, 1)) << "the largest, without a scale";
  EXPECT_EQ(whole.rgb(1, 0).g, 0);
}

TEST(Convert, RefusesSizesThatAreNone) {
  for (const char* size : {"2", "x", "2x", "x2", "0x2", "2x-1", "2x2x2", "2 x 2", "999999x2"}) {
    EXPECT_THROW(converted(greys(1, 1, {3}), {.resize = size}), std::runtime_error) << size;
  }
}

}  // namespace
}  // namespace pbrtmedia
