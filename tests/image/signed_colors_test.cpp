// SPDX-License-Identifier: BSD-2-Clause
#include "image/signed_colors.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "image/codecs.h"

namespace pbrtmedia {
namespace {

Image values(std::vector<float> y) {
  Image image(static_cast<int>(y.size()), 1, {"Y"});
  image.data() = std::move(y);
  image.metadata["derivative"] = "d/dx";
  return image;
}

/// As a PNG has it.
std::vector<int> bytesAt(const Image& image, int x) {
  const Rgb c = image.rgb(x, 0);
  return {quantizeSrgb(c.r), quantizeSrgb(c.g), quantizeSrgb(c.b)};
}

TEST(SignedColors, GoFromBlueOverWhiteToRed) {
  const Image out = signedColors(values({-9, -2, -1, 0, 1, 2}), 2, ZeroColor::White);
  EXPECT_EQ(bytesAt(out, 0), (std::vector<int>{0, 0, 255}));
  EXPECT_EQ(bytesAt(out, 1), (std::vector<int>{0, 0, 255}));
  EXPECT_EQ(bytesAt(out, 2), (std::vector<int>{128, 128, 255}));
  EXPECT_EQ(bytesAt(out, 3), (std::vector<int>{255, 255, 255}));
  EXPECT_EQ(bytesAt(out, 4), (std::vector<int>{255, 128, 128}));
  EXPECT_EQ(bytesAt(out, 5), (std::vector<int>{255, 0, 0}));
  EXPECT_EQ(out.metadata.at("derivative"), "d/dx");
}

TEST(SignedColors, GoOverBlackWhereThatIsZero) {
  const Image out = signedColors(values({-2, -1, 0, 1}), 2, ZeroColor::Black);
  EXPECT_EQ(bytesAt(out, 0), (std::vector<int>{0, 0, 255}));
  EXPECT_EQ(bytesAt(out, 1), (std::vector<int>{0, 0, 128}));
  EXPECT_EQ(bytesAt(out, 2), (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(bytesAt(out, 3), (std::vector<int>{128, 0, 0}));
}

TEST(SignedColors, ShowWhatIsNoNumber) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const Image out = signedColors(values({nan, -inf}), 1, ZeroColor::White);
  EXPECT_EQ(bytesAt(out, 0), (std::vector<int>{0, 255, 0}));
  EXPECT_EQ(bytesAt(out, 1), (std::vector<int>{0, 255, 0}));
  EXPECT_THROW(signedColors(Image(1, 1, {"U", "V"}), 1, ZeroColor::White), std::invalid_argument);
}

TEST(SignedColors, HaveAScaleThatFewPixelsDoNotDecide) {
  std::vector<float> y(400, -3);
  y[0] = y[1] = 1e6f;
  EXPECT_EQ(usualSize(values(y)), 3);
  y[2] = 1e5f;
  EXPECT_EQ(usualSize(values(y)), 1e5f);
  EXPECT_EQ(usualSize(values({0, 0})), 1);
  EXPECT_EQ(usualSize(values({0, -2})), 2);
  std::vector<float> mostlyZero(400, 0);
  mostlyZero[7] = 5;
  EXPECT_EQ(usualSize(values(mostlyZero)), 5);
  EXPECT_EQ(usualSize(values({std::numeric_limits<float>::infinity(), 1, 2})), 2);
}

}  // namespace
}  // namespace pbrtmedia
