// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image_helpers.h"

namespace pbrtmedia {
namespace {

using namespace std::string_literals;

TEST(Pfm, RoundTripsEveryBit) {
  Image image = patternImage(5, 4);
  image.at(1, 2, 0) = 1.0f / 3.0f;
  image.at(2, 2, 0) = std::numeric_limits<float>::infinity();
  const Image back = decodePfm(asBytes(encodePfm(image)), "a.pfm");
  EXPECT_EQ(back.channels(), image.channels());
  EXPECT_EQ(back.data(), image.data());
}

TEST(Pfm, RoundTripsGreyAsOneChannel) {
  const Image image = patternImage(3, 2, {"Y"});
  const std::string bytes = encodePfm(image);
  EXPECT_EQ(bytes.substr(0, 3), "Pf\n");
  EXPECT_EQ(bytes.size(), "Pf\n3 2\n-1.0\n"s.size() + 6 * 4);
  EXPECT_EQ(decodePfm(asBytes(bytes), "a.pfm").data(), image.data());
}

TEST(Pfm, ReadsBothEndiannessesAndStartsAtTheBottom) {
  // 1.5 = 0x3fc00000, -2 = 0xc0000000; the first value in the file is the bottom pixel.
  const Image big = decodePfm(asBytes("Pf 1 2 1\n\x3f\xc0\0\0\xc0\0\0\0"s), "a.pfm");
  EXPECT_EQ(big.at(0, 1, 0), 1.5f);
  EXPECT_EQ(big.at(0, 0, 0), -2.0f);
  const Image little = decodePfm(asBytes("Pf 1 2 -1\n\0\0\xc0\x3f\0\0\0\xc0"s), "a.pfm");
  EXPECT_EQ(little.data(), big.data());
}

TEST(Pfm, MultipliesByTheMagnitudeOfTheScale) {
  EXPECT_EQ(decodePfm(asBytes("Pf\n1 1\n-2.5\n\0\0\xc0\x3f"s), "a.pfm").data()[0], 3.75f);
  EXPECT_EQ(decodePfm(asBytes("Pf\n1 1\n0.5\n\x3f\xc0\0\0"s), "a.pfm").data()[0], 0.75f);
}

TEST(Pfm, RefusesHeadersThatMakeNoSense) {
  const std::string pixel = "\0\0\0\0"s;
  expectRefused(ImageFormat::Pfm, "PG 1 1 1\n" + pixel, "\"PF\"");
  expectRefused(ImageFormat::Pfm, "Pf 0 1 1\n" + pixel, "width and height");
  expectRefused(ImageFormat::Pfm, "Pf -1 1 1\n" + pixel, "width and height");
  expectRefused(ImageFormat::Pfm, "Pf 1 x 1\n" + pixel, "width and height");
  expectRefused(ImageFormat::Pfm, "Pf 1 1 0\n" + pixel, "scale");
  expectRefused(ImageFormat::Pfm, "Pf 1 1 nan\n" + pixel, "scale");
  expectRefused(ImageFormat::Pfm, "Pf 1 1 inf\n" + pixel, "scale");
  expectRefused(ImageFormat::Pfm, "Pf 99999999999 1 1\n" + pixel, "width and height");
  expectRefused(ImageFormat::Pfm, "Pf 2147483647 2147483647 1\n" + pixel, "need more than the 4 bytes");
  expectRefused(ImageFormat::Pfm, "PF 1 1 1\n" + pixel, "need more than the 4 bytes");
}

TEST(Pfm, RefusesEveryTruncation) {
  const std::string bytes = encodePfm(patternImage(3, 2));
  expectPrefixesRefused(ImageFormat::Pfm, bytes, bytes.size());
}

TEST(Pfm, SurvivesByteChanges) { expectSurvivesByteChanges(ImageFormat::Pfm, encodePfm(patternImage(3, 2))); }

TEST(Pfm, RefusesImagesWithoutColour) {
  EXPECT_THROW(encodePfm(Image(2, 2, {"u", "v"})), std::runtime_error);
}

}  // namespace
}  // namespace pbrtmedia
