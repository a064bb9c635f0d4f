// SPDX-License-Identifier: BSD-2-Clause
#include "image/resample.h"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

#include "image_helpers.h"

namespace pbrtmedia {
namespace {

double meanOf(const Image& image) {
  return std::accumulate(image.data().begin(), image.data().end(), 0.0) /
         static_cast<double>(image.data().size());
}

TEST(Resize, HalvingWithABoxAveragesBlocks) {
  Image image(4, 2, {"Y"});
  image.data() = {1, 3, 10, 20, 5, 7, 30, 40};
  EXPECT_EQ(resize(image, 2, 1, ResizeFilter::Box).data(), (std::vector<float>{4, 25}));
}

TEST(Resize, ToTheSameSizeChangesNothing) {
  const Image image = patternImage(5, 4);
  EXPECT_EQ(resize(image, 5, 4, ResizeFilter::Box).data(), image.data());
  const Image lanczos = resize(image, 5, 4, ResizeFilter::Lanczos);
  for (std::size_t i = 0; i < image.data().size(); ++i) {
    EXPECT_NEAR(lanczos.data()[i], image.data()[i], 1e-6f);
  }
}

TEST(Resize, BoxKeepsTheMeanForAnyShrinking) {
  const Image image = patternImage(37, 23);
  for (const Point2i size : {Point2i{10, 7}, Point2i{1, 1}, Point2i{36, 22}}) {
    EXPECT_NEAR(meanOf(resize(image, size.x, size.y, ResizeFilter::Box)), meanOf(image), 1e-6);
  }
}

TEST(Resize, KeepsConstants) {
  Image image(9, 6);
  for (float& v : image.data()) v = 0.7f;
  for (const ResizeFilter filter : {ResizeFilter::Box, ResizeFilter::Lanczos}) {
    for (const Point2i size : {Point2i{4, 3}, Point2i{20, 17}, Point2i{1, 40}}) {
      const Image out = resize(image, size.x, size.y, filter);
      ASSERT_EQ(out.width(), size.x);
      ASSERT_EQ(out.height(), size.y);
      for (const float v : out.data()) ASSERT_NEAR(v, 0.7f, 1e-6f);
    }
  }
}

TEST(Resize, LanczosFollowsARampAwayFromTheEdges) {
  Image ramp(64, 1, {"Y"});
  for (int x = 0; x < 64; ++x) ramp.at(x, 0, 0) = static_cast<float>(x) + 0.5f;
  const Image out = resize(ramp, 128, 1, ResizeFilter::Lanczos);
  for (int x = 20; x < 108; ++x) EXPECT_NEAR(out.at(x, 0, 0), (static_cast<float>(x) + 0.5f) / 2, 0.02f);
}

TEST(Resize, LanczosAveragesWhatIsTooFineForFewerPixels) {
  // Columns 0 and 1 by turns; a filter that is not widened takes every third of them as it is.
  Image columns(96, 1, {"Y"});
  for (int x = 0; x < 96; ++x) columns.at(x, 0, 0) = static_cast<float>(x % 2);
  const Image out = resize(columns, 32, 1, ResizeFilter::Lanczos);
  for (int x = 4; x < 28; ++x) EXPECT_NEAR(out.at(x, 0, 0), 0.5f, 0.03f) << x;
}

TEST(Resize, ResetsWindowsAndKeepsMetadata) {
  Image image = patternImage(4, 4);
  image.dataWindow = {{2, 2}, {6, 6}};
  image.displayWindow = {{0, 0}, {9, 9}};
  image.metadata = {{"seed", "3"}};
  const Image out = resize(image, 2, 2, ResizeFilter::Box);
  EXPECT_EQ(out.dataWindow, (Bounds2i{{0, 0}, {2, 2}}));
  EXPECT_EQ(out.displayWindow, out.dataWindow);
  EXPECT_EQ(out.metadata, image.metadata);
}

TEST(Resize, RefusesEmptyImages) {
  EXPECT_THROW(resize(patternImage(2, 2), 0, 1, ResizeFilter::Box), std::invalid_argument);
  EXPECT_THROW(resize(Image(0, 0), 1, 1, ResizeFilter::Box), std::invalid_argument);
}

TEST(Crop, KnowsWhereItWasTaken) {
  Image image = patternImage(5, 4);
  image.dataWindow = {{10, 20}, {15, 24}};
  image.displayWindow = {{0, 0}, {100, 100}};
  const Image out = crop(image, {{1, 2}, {4, 4}});
  EXPECT_EQ(out.width(), 3);
  EXPECT_EQ(out.height(), 2);
  EXPECT_EQ(out.rgb(2, 1), image.rgb(3, 3));
  EXPECT_EQ(out.dataWindow, (Bounds2i{{11, 22}, {14, 24}}));
  EXPECT_EQ(out.displayWindow, image.displayWindow);
  EXPECT_THROW(crop(image, {{0, 0}, {6, 1}}), std::invalid_argument);
  EXPECT_THROW(crop(image, {{-1, 0}, {2, 1}}), std::invalid_argument);
  EXPECT_THROW(crop(image, {{2, 0}, {2, 1}}), std::invalid_argument);
}

TEST(RepeatPixels, MakesBlocks) {
  Image image(2, 1, {"Y"});
  image.data() = {1, 2};
  const Image out = repeatPixels(image, 2);
  EXPECT_EQ(out.data(), (std::vector<float>{1, 1, 2, 2, 1, 1, 2, 2}));
  EXPECT_EQ(out.dataWindow, (Bounds2i{{0, 0}, {4, 2}}));
  EXPECT_THROW(repeatPixels(image, 0), std::invalid_argument);
  EXPECT_THROW(repeatPixels(image, 1 << 30), std::invalid_argument);
}

TEST(FlipVertically, MirrorsPixelsAndTheDataWindow) {
  Image image = patternImage(3, 2);
  image.dataWindow = {{0, 1}, {3, 3}};
  image.displayWindow = {{0, 0}, {3, 10}};
  const Image out = flipVertically(image);
  EXPECT_EQ(out.rgb(1, 0), image.rgb(1, 1));
  EXPECT_EQ(out.dataWindow, (Bounds2i{{0, 7}, {3, 9}}));
  EXPECT_EQ(flipVertically(out).data(), image.data());
  EXPECT_EQ(flipVertically(out).dataWindow, image.dataWindow);
}

}  // namespace
}  // namespace pbrtmedia
