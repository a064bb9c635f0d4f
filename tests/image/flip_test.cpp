// SPDX-License-Identifier: BSD-2-Clause
#include "image/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace pbrtmedia {
namespace {

Image constant(int width, int height, Rgb c) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.setRgb(x, y, c);
  }
  return image;
}

/// White right of column `edge`, black left of it.
Image step(int size, int edge) {
  Image image(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = edge; x < size; ++x) image.setRgb(x, y, Rgb(1));
  }
  return image;
}

TEST(Flip, IsZeroForEqualImages) {
  const Image map = flipMap(step(40, 20), step(40, 20));
  for (const float v : map.data()) ASSERT_EQ(v, 0);
  EXPECT_EQ(flipMean(map), 0);
}

TEST(Flip, BlackAgainstWhiteIsTheClosedForm) {
  // No features; ΔL* = 100, so 100^0.7 = 25.1189. The largest difference, green to blue with Hunt's
  // adjustment: green (87.7347, -86.1827, 83.1793), blue (32.2970, 79.1875, -107.8602) in L*a*b* give
  // HyAB 203.30 and 203.30^0.7 = 41.276. Above the knee 0.4 * 41.276 = 16.510:
  // 0.95 + 0.05 (25.1189 - 16.510) / (41.276 - 16.510) = 0.96738.
  const Image map = flipMap(constant(8, 8, Rgb(0)), constant(8, 8, Rgb(1)));
  for (const float v : map.data()) ASSERT_NEAR(v, 0.96738f, 2e-5f);
}

TEST(Flip, GreyDifferenceBelowTheKneeIsTheClosedForm) {
  // Linear 0.18418651 is L* = 50, linear 0.11250973 is L* = 40: ΔL* 10, 10^0.7 = 5.01187;
  // 0.95 / 16.5104 * 5.01187 = 0.28838.
  const auto linear = [](double l) { return static_cast<float>(std::pow((l + 16) / 116, 3)); };
  const Image map = flipMap(constant(8, 8, Rgb(linear(50))), constant(8, 8, Rgb(linear(40))));
  for (const float v : map.data()) ASSERT_NEAR(v, 0.28838f, 5e-5f);
}

TEST(Flip, IsSymmetricAndStaysInTheUnitInterval) {
  const Image a = step(60, 30), b = step(60, 34);
  const Image ab = flipMap(a, b), ba = flipMap(b, a);
  EXPECT_EQ(ab.data(), ba.data());
  for (const float v : ab.data()) {
    ASSERT_GE(v, 0);
    ASSERT_LE(v, 1);
  }
}

TEST(Flip, GrowsWithTheErrorAndIsLocal) {
  Image reference = constant(120, 120, Rgb(0.5f)), small = reference, large = reference;
  for (int y = 55; y < 65; ++y) {
    for (int x = 55; x < 65; ++x) {
      small.setRgb(x, y, Rgb(0.55f));
      large.setRgb(x, y, Rgb(0.9f));
    }
  }
  const Image smallMap = flipMap(reference, small), largeMap = flipMap(reference, large);
  EXPECT_GT(flipMean(smallMap), 0);
  EXPECT_GT(flipMean(largeMap), 2 * flipMean(smallMap));
  EXPECT_GT(largeMap.at(60, 60, 0), 0.3f);
  EXPECT_LT(largeMap.at(5, 5, 0), 1e-3f);
}

TEST(Flip, SeesAMissingEdgeAsMoreThanItsColour) {
  // A thin line changes the filtered colour little; the feature term must raise the error above it.
  Image reference = constant(80, 80, Rgb(0.2f)), line = reference;
  for (int y = 0; y < 80; ++y) line.setRgb(40, y, Rgb(0.4f));
  const Image fine = flipMap(reference, line, 67),
              smooth = flipMap(reference, constant(80, 80, Rgb(0.21f)), 67);
  EXPECT_GT(fine.at(40, 40, 0), smooth.at(40, 40, 0));
}

TEST(Flip, TakesDistanceIntoAccount) {
  // Pixel noise that is visible up close is filtered away from far (many pixels per degree).
  const Image reference = constant(64, 64, Rgb(0.5f));
  Image noisy = reference;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) noisy.setRgb(x, y, Rgb((x + y) % 2 == 0 ? 0.4f : 0.6f));
  }
  EXPECT_LT(flipMean(flipMap(reference, noisy, 100)), 0.5 * flipMean(flipMap(reference, noisy, 20)));
}

TEST(Flip, ClampsToWhatADisplayShows) {
  const Image map = flipMap(constant(4, 4, Rgb(1)), constant(4, 4, Rgb(50)));
  EXPECT_EQ(flipMean(map), 0);
}

TEST(Flip, RefusesWhatItCannotCompare) {
  EXPECT_THROW(flipMap(Image(2, 2), Image(2, 3)), std::invalid_argument);
  EXPECT_THROW(flipMap(Image(0, 0), Image(0, 0)), std::invalid_argument);
  EXPECT_THROW(flipMap(Image(2, 2, {"u", "v"}), Image(2, 2, {"u", "v"})), std::invalid_argument);
  EXPECT_THROW(flipMap(Image(2, 2), Image(2, 2), 0), std::invalid_argument);
  const Image bad = constant(2, 2, Rgb(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_THROW(flipMap(bad, Image(2, 2)), std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
