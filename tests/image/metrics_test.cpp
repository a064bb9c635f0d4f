// SPDX-License-Identifier: BSD-2-Clause
#include "image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pbrtmedia {
namespace {

Image twoByTwo(std::vector<float> values) {
  Image image(2, 2, {"Y"});
  image.data() = std::move(values);
  return image;
}

ImageDifference differenceOf(const Image& test, const Image& reference,
                             double epsilon = kRelativeMseEpsilon) {
  return std::get<ImageDifference>(compareImages(test, reference, epsilon));
}

std::string failureOf(const Image& test, const Image& reference) {
  const auto result = compareImages(test, reference);
  const auto* failure = std::get_if<ComparisonFailure>(&result);
  return failure != nullptr ? failure->reason : "";
}

TEST(Metrics, AgreeWithHandComputedValues) {
  // Differences 0, 1, -2, 0.5; squares 0, 1, 4, 0.25.
  const Image test = twoByTwo({1, 3, 1, 0.5f}), reference = twoByTwo({1, 2, 3, 0});
  const ImageDifference d = differenceOf(test, reference, 1.0);
  ASSERT_EQ(d.channels.size(), 1u);
  EXPECT_DOUBLE_EQ(d.total.meanTest, 5.5 / 4);
  EXPECT_DOUBLE_EQ(d.total.meanReference, 6.0 / 4);
  EXPECT_DOUBLE_EQ(d.total.meanSigned, -0.5 / 4);
  EXPECT_DOUBLE_EQ(d.total.mse, 5.25 / 4);
  EXPECT_DOUBLE_EQ(d.total.rmse, std::sqrt(5.25 / 4));
  // 0/2 + 1/5 + 4/10 + 0.25/1
  EXPECT_DOUBLE_EQ(d.total.relativeMse, 0.85 / 4);
  // 0/1 + 1/2.5 + 2/2 + 0.5/0.25
  EXPECT_DOUBLE_EQ(d.total.smape, (1 / 2.5 + 1 + 2) / 4);
  EXPECT_DOUBLE_EQ(d.total.relativeMseRobust, 0.45 / 3) << "without the pixel of 4/10";
  EXPECT_DOUBLE_EQ(d.total.maxAbs, 2);
  EXPECT_EQ(d.total.maxAt, (Point2i{0, 1}));
  EXPECT_EQ(d.maxChannel, "Y");
  EXPECT_EQ(d.differingPixels, 3);
  EXPECT_DOUBLE_EQ(d.channels[0].mse, d.total.mse);
}

TEST(Metrics, RobustMeansLeaveTheWorstTenThousandthOut) {
  // 29999 pixels: three are left out. By the mean over channels pixel 100 is the fourth worst.
  Image test(29999, 1, {"R", "G"}), reference(29999, 1, {"R", "G"});
  for (float& v : reference.data()) v = 1;
  for (float& v : test.data()) v = 1.5f;
  test.at(7, 0, 0) = 1001;
  test.at(8, 0, 1) = 101;
  for (const std::size_t c : {0, 1}) {
    test.at(29998, 0, c) = 61;
    test.at(100, 0, c) = 11;
  }
  const ImageDifference d = differenceOf(test, reference, 1.0);
  EXPECT_GT(d.total.relativeMse, 8);
  EXPECT_DOUBLE_EQ(d.total.relativeMseRobust, (29995 * .125 + 50) / 29996);
  EXPECT_DOUBLE_EQ(d.channels[1].relativeMseRobust, .125);
  EXPECT_EQ(differenceOf(Image(1, 1), Image(1, 1)).total.relativeMseRobust, 0) << "nothing is left";
}

TEST(Metrics, DefaultEpsilonIsOneHundredth) {
  const ImageDifference d = differenceOf(twoByTwo({1, 0, 0, 0}), twoByTwo({0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(d.epsilon, 1e-2);
  EXPECT_DOUBLE_EQ(d.total.relativeMse, 100.0 / 4);
}

TEST(Metrics, AreKeptPerChannelAndTogether) {
  Image test(1, 1), reference(1, 1);
  test.data() = {1, 2, 3};
  reference.data() = {1, 1, 5};
  const ImageDifference d = differenceOf(test, reference);
  EXPECT_EQ(d.channels[0].channel, "R");
  EXPECT_DOUBLE_EQ(d.channels[0].mse, 0);
  EXPECT_DOUBLE_EQ(d.channels[1].meanSigned, 1);
  EXPECT_DOUBLE_EQ(d.channels[2].meanSigned, -2);
  EXPECT_DOUBLE_EQ(d.channels[2].maxAbs, 2);
  EXPECT_DOUBLE_EQ(d.total.mse, 5.0 / 3);
  EXPECT_EQ(d.maxChannel, "B");
}

TEST(Metrics, MatchChannelsByNameNotByOrder) {
  Image test(1, 1, {"B", "R", "G"}), reference(1, 1);
  test.data() = {3, 1, 2};
  reference.data() = {1, 2, 3};
  EXPECT_EQ(differenceOf(test, reference).differingPixels, 0);
}

TEST(Metrics, IdenticalImagesDifferByExactlyNothing) {
  Image image(7, 5);
  float v = 0.1f;
  for (float& x : image.data()) x = (v *= 1.3f);
  const ImageDifference d = differenceOf(image, image);
  EXPECT_EQ(d.total.mse, 0);
  EXPECT_EQ(d.total.maxAbs, 0);
  EXPECT_EQ(d.total.meanSigned, 0);
  EXPECT_EQ(d.differingPixels, 0);
}

TEST(Metrics, SmallErrorsOfLargeImagesKeepThreeDigits) {
  // 3.1 million differences of ±1e-5 on 2^-7, where floats are 5e-10 apart: MSE 1e-10 within 0.01 %.
  constexpr float kBase = 0x1p-7f;
  Image test(1024, 1024), reference(1024, 1024);
  std::size_t i = 0;
  for (float& v : test.data()) v = kBase + ((i++ & 1) ? 1e-5f : -1e-5f);
  for (float& v : reference.data()) v = kBase;
  const ImageDifference d = differenceOf(test, reference);
  EXPECT_NEAR(d.total.mse, 1e-10, 1e-13);
  EXPECT_NEAR(d.total.rmse, 1e-5, 1e-8);
  EXPECT_NEAR(d.total.meanSigned, 0, 1e-9);
}

TEST(Metrics, MeanSignedErrorKeepsTheDigitsOfATinyBias) {
  Image test(1024, 1024, {"Y"}), reference(1024, 1024, {"Y"});
  for (float& v : test.data()) v = 1.0f + 0x1p-20f;
  for (float& v : reference.data()) v = 1.0f;
  EXPECT_NEAR(differenceOf(test, reference).total.meanSigned, 0x1p-20, 1e-15);
}

TEST(Metrics, OtherSizesAreAFailure) {
  EXPECT_EQ(failureOf(Image(2, 3), Image(3, 2)), "different sizes: 2 x 3 and 3 x 2");
  EXPECT_EQ(failureOf(Image(0, 0), Image(0, 0)), "images without pixels");
}

TEST(Metrics, MissingChannelsAreAFailure) {
  EXPECT_EQ(failureOf(Image(2, 2, {"R", "G"}), Image(2, 2)), "channel \"B\" is missing in the first image");
  EXPECT_EQ(failureOf(Image(2, 2, {"R", "G", "B", "A"}), Image(2, 2)),
            "channel \"A\" is missing in the second image");
}

TEST(Metrics, NanAndInfinityAreAFailureEvenWhenBothHaveThem) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const Image good = twoByTwo({1, 2, 3, 4});
  EXPECT_EQ(failureOf(twoByTwo({1, 2, 3, nan}), good),
            "the first image has the value nan at pixel (1, 1), channel \"Y\"");
  EXPECT_EQ(failureOf(good, twoByTwo({1, -inf, 3, 4})),
            "the second image has the value -inf at pixel (1, 0), channel \"Y\"");
  const Image bad = twoByTwo({inf, 2, 3, 4});
  EXPECT_NE(failureOf(bad, bad), "");
}

}  // namespace
}  // namespace pbrtmedia
