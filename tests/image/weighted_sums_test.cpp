// SPDX-License-Identifier: BSD-2-Clause
#include "image/weighted_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

std::vector<WeightedSums> someSums() {
  return {{1.0 / 3, 1e-20 / 7, -2e30 / 3, 64.0000000000001}, {0, std::sqrt(2), 1e9 + 1e-6, -.25}};
}

TEST(WeightedSums, ComeBackExactlyFromAFloatImage) {
  Image image(2, 1, {"R", "G", "B", "Z"});
  image.data() = {1, 2, 3, 4, 5, 6, 7, 8};
  image.metadata.emplace("seed", "5");
  const std::vector<WeightedSums> sums = someSums();
  const TemporaryFolder folder;
  writeImage(folder.path() / "a.exr", withSums(image, sums, {.scale = .1f, .keepsNegatives = true}),
             {.pixelType = PixelType::Float});
  const Image back = readImage(folder.path() / "a.exr");
  ASSERT_TRUE(sumsOf(back));
  EXPECT_EQ(sumsOf(back)->colours, sums);
  EXPECT_TRUE(sumsOf(back)->others.empty());
  EXPECT_EQ(developmentOf(back).scale, .1f);
  EXPECT_TRUE(developmentOf(back).keepsNegatives);
  const Image plain = withoutSums(back);
  EXPECT_EQ(plain.channelCount(), 4u);
  for (int x = 0; x < 2; ++x) {
    EXPECT_EQ(plain.rgb(x, 0), image.rgb(x, 0));
    EXPECT_EQ(plain.at(x, 0, *plain.channelIndex("Z")), image.at(x, 0, 3));
  }
  EXPECT_EQ(plain.metadata.at("seed"), "5");
  EXPECT_FALSE(plain.metadata.contains("filmScale"));
  EXPECT_FALSE(sumsOf(plain));
}

TEST(WeightedSums, HaveAsManyOthersBesideThemAsAreWanted) {
  // Numbers of two digits come after those of one, whatever the order of names in a file.
  std::vector<double> others;
  for (int i = 0; i < 22; ++i) others.push_back(std::sqrt(i) * 1e3);
  const TemporaryFolder folder;
  writeImage(folder.path() / "a.exr", withSums(Image(2, 1), someSums(), {}, others),
             {.pixelType = PixelType::Half});
  const auto back = sumsOf(readImage(folder.path() / "a.exr"));
  ASSERT_TRUE(back) << "half floats are for colours alone";
  EXPECT_EQ(back->colours, someSums());
  EXPECT_EQ(back->others, others);
  EXPECT_EQ(withoutSums(readImage(folder.path() / "a.exr")).channelCount(), 3u);
  EXPECT_THROW(withSums(Image(2, 1), someSums(), {}, std::span(others).first(3)), std::invalid_argument);
}

TEST(WeightedSums, AreNoneWhenTheyWereChanged) {
  Image image = withSums(Image(2, 1), someSums(), {});
  EXPECT_TRUE(sumsOf(image));
  image.at(1, 0, 5) = std::nextafter(image.at(1, 0, 5), 1e9f);
  EXPECT_FALSE(sumsOf(image));
  EXPECT_THROW(withSums(Image(3, 1), someSums(), {}), std::invalid_argument);
  image.metadata.insert_or_assign("filmScale", std::string(1, 'x'));
  EXPECT_THROW(developmentOf(image), std::invalid_argument);
}

TEST(WeightedSums, DevelopAsFilmsDo) {
  const Development plain{.scale = 3};
  EXPECT_EQ(plain.colour({2, -4, 6, 2}), Rgb(3, 0, 9));
  EXPECT_EQ(plain.colour({2, 4, 6, 0}), Rgb(0)) << "no sample";
  const Development negative{.scale = 3, .keepsNegatives = true};
  EXPECT_EQ(negative.colour({2, -4, 6, 2}), Rgb(3, -6, 9));
  EXPECT_EQ(plain.value(1e300), std::numeric_limits<float>::max());
}

}  // namespace
}  // namespace pbrtmedia
