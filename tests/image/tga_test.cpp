// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "image_helpers.h"

namespace pbrtmedia {
namespace {

using namespace std::string_literals;

struct Fields {
  int type = 2, width = 2, height = 2, bits = 24, descriptor = 32;
  int paletteLength = 0, paletteBits = 0, paletteFirst = 0;
  std::string id = {}, palette = {};
};

std::string makeTga(const Fields& f, const std::string& pixels) {
  std::string h(18, '\0');
  h[0] = static_cast<char>(f.id.size());
  h[1] = f.paletteLength > 0 ? 1 : 0;
  h[2] = static_cast<char>(f.type);
  setWord(h, 3, static_cast<unsigned>(f.paletteFirst), 2, false);
  setWord(h, 5, static_cast<unsigned>(f.paletteLength), 2, false);
  h[7] = static_cast<char>(f.paletteBits);
  setWord(h, 12, static_cast<unsigned>(f.width), 2, false);
  setWord(h, 14, static_cast<unsigned>(f.height), 2, false);
  h[16] = static_cast<char>(f.bits);
  h[17] = static_cast<char>(f.descriptor);
  return h + f.id + f.palette + pixels;
}

Image decode(const Fields& f, const std::string& pixels) {
  return decodeTga(asBytes(makeTga(f, pixels)), "a.tga");
}

// Four mono pixels 10, 20, 30, 40 in file order.
const std::string kFour = "\x0a\x14\x1e\x28"s;

std::vector<int> bytesOf(const Image& image) {
  std::vector<int> out;
  for (const float v : image.data()) out.push_back(static_cast<int>(v * 255.0f + 0.5f));
  return out;
}

TEST(Tga, HonoursAllFourOrigins) {
  Fields f{.type = 3, .bits = 8};
  EXPECT_EQ(bytesOf(decode(f, kFour)), (std::vector<int>{10, 20, 30, 40}));
  f.descriptor = 0;
  EXPECT_EQ(bytesOf(decode(f, kFour)), (std::vector<int>{30, 40, 10, 20}));
  f.descriptor = 16;
  EXPECT_EQ(bytesOf(decode(f, kFour)), (std::vector<int>{40, 30, 20, 10}));
  f.descriptor = 48;
  EXPECT_EQ(bytesOf(decode(f, kFour)), (std::vector<int>{20, 10, 40, 30}));
}

TEST(Tga, ReadsColoursAsBlueGreenRed) {
  const Image image = decode({.width = 1, .height = 1, .id = "an id field"}, "\x33\x66\x99"s);
  EXPECT_EQ(image.rgb(0, 0), Rgb(0.6f, 0.4f, 0.2f));
}

TEST(Tga, KeepsAlphaOnlyWhenTheHeaderHasAlphaBits) {
  const Image with = decode({.width = 1, .height = 1, .bits = 32, .descriptor = 40}, "\x33\x66\x99\x33"s);
  EXPECT_EQ(with.channels(), (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(with.at(0, 0, 3), 0.2f);
  const Image without = decode({.width = 1, .height = 1, .bits = 32}, "\x33\x66\x99\x33"s);
  EXPECT_EQ(without.channels(), (std::vector<std::string>{"R", "G", "B"}));
}

TEST(Tga, ReadsFiveBitColours) {
  // 0 rrrrr ggggg bbbbb = 31, 1, 0 -> 0x7c20
  const Image image = decode({.width = 1, .height = 1, .bits = 16}, "\x20\x7c"s);
  EXPECT_EQ(image.rgb(0, 0), Rgb(1, 1 / 31.0f, 0));
}

TEST(Tga, ReadsMonoWithAlpha) {
  const Image image = decode({.type = 3, .width = 1, .height = 1, .bits = 16, .descriptor = 40}, "\x33\x66"s);
  EXPECT_EQ(image.channels(), (std::vector<std::string>{"Y", "A"}));
  EXPECT_EQ(image.at(0, 0, 1), 0.4f);
}

TEST(Tga, ReadsPalettesFromTheirFirstEntry) {
  Fields f{.type = 1,
           .width = 2,
           .height = 1,
           .bits = 8,
           .paletteLength = 2,
           .paletteBits = 24,
           .paletteFirst = 5};
  f.palette = "\x00\x00\xff\x00\xff\x00"s;  // entry 5 red, entry 6 green
  const Image image = decode(f, "\x06\x05"s);
  EXPECT_EQ(image.rgb(0, 0), Rgb(0, 1, 0));
  EXPECT_EQ(image.rgb(1, 0), Rgb(1, 0, 0));
  expectRefused(ImageFormat::Tga, makeTga(f, "\x06\x04"s), "palette index 4");
  expectRefused(ImageFormat::Tga, makeTga(f, "\x06\x07"s), "palette index 7");
}

TEST(Tga, ExpandsRunsAlsoAcrossRows) {
  const Fields f{.type = 11, .bits = 8};
  EXPECT_EQ(bytesOf(decode(f, "\x82\x0a\x00\x28"s)), (std::vector<int>{10, 10, 10, 40}));
  EXPECT_EQ(bytesOf(decode(f, "\x03"s + kFour)), (std::vector<int>{10, 20, 30, 40}));
  const Fields colour{.type = 10, .width = 3, .height = 1};
  const Image image = decode(colour, "\x81\x33\x66\x99\x00\x00\x00\xff"s);
  EXPECT_EQ(image.rgb(1, 0), Rgb(0.6f, 0.4f, 0.2f));
  EXPECT_EQ(image.rgb(2, 0), Rgb(1, 0, 0));
}

TEST(Tga, RefusesRunsThatGoTooFarOrStopTooEarly) {
  expectRefused(ImageFormat::Tga, makeTga({.type = 11, .bits = 8}, "\x84\x0a"s), "past the last pixel");
  expectRefused(ImageFormat::Tga, makeTga({.type = 11, .bits = 8}, "\x81\x0a"s), "ends early");
}

TEST(Tga, RefusesGiantSizesAtOnce) {
  Fields f{.width = 65535, .height = 65535};
  expectRefused(ImageFormat::Tga, makeTga(f, kFour), "do not fit");
  f.type = 10;
  expectRefused(ImageFormat::Tga, makeTga(f, kFour), "do not fit");
}

TEST(Tga, RefusesKindsThatDoNotExist) {
  expectRefused(ImageFormat::Tga, makeTga({.type = 0}, kFour), "unknown image type 0");
  expectRefused(ImageFormat::Tga, makeTga({.type = 4}, kFour), "unknown image type 4");
  expectRefused(ImageFormat::Tga, makeTga({.bits = 12}, kFour), "depth of 12");
  expectRefused(ImageFormat::Tga, makeTga({.width = 0}, kFour), "no pixels");
  expectRefused(ImageFormat::Tga, makeTga({.type = 1, .bits = 8}, kFour), "without a palette");
}

TEST(Tga, WritesTwentyFourBitsThatReadBack) {
  Image image(2, 1);
  image.data() = {0.5f, 0.18f, 1.0f, 0.0f, 2.0f, -1.0f};
  const std::string bytes = encodeTga(image);
  EXPECT_EQ(bytes.size(), 18u + 6u);
  const Image back = decodeTga(asBytes(bytes), "a.tga");
  EXPECT_EQ(bytesOf(back), (std::vector<int>{188, 118, 255, 0, 255, 0}));
}

TEST(Tga, RefusesEveryTruncation) {
  const std::string plain = encodeTga(patternImage(3, 2));
  expectPrefixesRefused(ImageFormat::Tga, plain, plain.size());
  const std::string runs = makeTga({.type = 11, .bits = 8}, "\x82\x0a\x00\x28"s);
  expectPrefixesRefused(ImageFormat::Tga, runs, runs.size());
}

TEST(Tga, SurvivesByteChanges) {
  expectSurvivesByteChanges(ImageFormat::Tga, encodeTga(patternImage(3, 2)));
  Fields f{.type = 9, .width = 2, .height = 2, .bits = 8, .paletteLength = 2, .paletteBits = 24};
  f.palette = "\x01\x02\x03\x04\x05\x06"s;
  expectSurvivesByteChanges(ImageFormat::Tga, makeTga(f, "\x82\x01\x00\x00"s));
}

}  // namespace
}  // namespace pbrtmedia
