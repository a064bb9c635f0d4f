// SPDX-License-Identifier: BSD-2-Clause
#include "image/tonemap.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "image_helpers.h"

namespace pbrtmedia {
namespace {

Image onePixel(Rgb c) {
  Image image(1, 1, {"R", "G", "B", "A"});
  image.setRgb(0, 0, c);
  image.at(0, 0, 3) = 0.5f;
  return image;
}

TEST(ScaleColors, LeavesOtherChannels) {
  Image image = onePixel({1, 2, 3});
  scaleColors(image, 2);
  EXPECT_EQ(image.data(), (std::vector<float>{2, 4, 6, 0.5f}));
}

TEST(ToneMap, MultipliesByReinhardsFactor) {
  Image image = onePixel(Rgb(3));  // Y = 3: factor (1 + 3/4) / 4 for Ymax = 2
  toneMap(image, 2);
  EXPECT_NEAR(image.rgb(0, 0).g, 3 * 1.75f / 4, 1e-5f);
}

TEST(ToneMap, SendsTheMaximumToOneAndKeepsBlackAndHue) {
  Image image = onePixel(Rgb(5));
  toneMap(image, 5);
  EXPECT_NEAR(image.rgb(0, 0).r, 1, 1e-5f);
  image = onePixel(Rgb(0));
  toneMap(image, 1);
  EXPECT_EQ(image.rgb(0, 0), Rgb(0));
  image = onePixel({4, 2, 1});
  toneMap(image, 1);
  EXPECT_NEAR(image.rgb(0, 0).r / image.rgb(0, 0).b, 4, 1e-4f);
  EXPECT_THROW(toneMap(image, 0), std::invalid_argument);
}

TEST(PreserveColors, DividesOnlyWhatWouldClip) {
  Image image = onePixel({4, 2, 1});
  preserveColors(image);
  EXPECT_EQ(image.rgb(0, 0), Rgb(1, 0.5f, 0.25f));
  image = onePixel({0.9f, 0.5f, 0});
  preserveColors(image);
  EXPECT_EQ(image.rgb(0, 0), Rgb(0.9f, 0.5f, 0));
}

TEST(Despike, ReplacesOnlyBrightPixelsByTheMedian) {
  Image image(3, 3, {"Y"});
  image.data() = {1, 2, 3, 4, 100, 5, 6, 7, 8};
  despike(image, 50);
  EXPECT_EQ(image.data(), (std::vector<float>{1, 2, 3, 4, 5, 5, 6, 7, 8}));
}

TEST(Despike, TakesAPixelExactlyAtTheLevelForASpike) {
  Image image(3, 1, {"Y"});
  image.data() = {1, 50, 2};
  despike(image, image.rgb(1, 0).luminance());
  EXPECT_EQ(image.data(), (std::vector<float>{1, 2, 2}));
}

TEST(Despike, ReadsTheUnfilteredImage) {
  Image image(3, 1, {"Y"});
  image.data() = {100, 100, 1};
  despike(image, 50);
  // Left: upper median of {100, 100}; middle: median of {1, 100, 100}.
  EXPECT_EQ(image.data(), (std::vector<float>{100, 100, 1}));
}

TEST(Bloom, LeavesImagesBelowTheLevelAlone) {
  Image image = patternImage(8, 8);
  const Image before = image;
  bloom(image, {.level = 1000});
  EXPECT_EQ(image.data(), before.data());
}

TEST(Bloom, AddsTheScaledGlowOfAConstantImageEverywhere) {
  Image image(6, 6, {"Y"});
  for (float& v : image.data()) v = 2;
  bloom(image, {.level = 1, .width = 5, .scale = 0.25f, .iterations = 3});
  for (const float v : image.data()) EXPECT_NEAR(v, 2.5f, 1e-5f);
}

TEST(Bloom, SpreadsOnePixelSymmetricallyAndKeepsItsEnergyInside) {
  Image image(31, 31, {"Y"});
  image.at(15, 15, 0) = 10;
  bloom(image, {.level = 5, .width = 7, .scale = 1, .iterations = 2});
  EXPECT_GT(image.at(18, 15, 0), 0);
  EXPECT_FLOAT_EQ(image.at(12, 15, 0), image.at(18, 15, 0));
  EXPECT_FLOAT_EQ(image.at(15, 12, 0), image.at(15, 18, 0));
  EXPECT_EQ(image.at(25, 15, 0), 0);  // two blurs of radius 3 reach 6 pixels
  double sum = 0;
  for (const float v : image.data()) sum += static_cast<double>(v);
  EXPECT_NEAR(sum, 20, 1e-4);
}

TEST(Bloom, RefusesWidthsThatHaveNoCentre) {
  Image image(2, 2);
  EXPECT_THROW(bloom(image, {.width = 4}), std::invalid_argument);
  EXPECT_THROW(bloom(image, {.width = 0}), std::invalid_argument);
  EXPECT_THROW(bloom(image, {.iterations = 0}), std::invalid_argument);
}

TEST(ColourOperations, RefuseImagesWithoutColour) {
  Image image(2, 2, {"u", "v"});
  EXPECT_THROW(scaleColors(image, 2), std::invalid_argument);
  EXPECT_THROW(despike(image, 2), std::invalid_argument);
  EXPECT_THROW(bloom(image, {}), std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
