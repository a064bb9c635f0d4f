// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include <chrono>

#include "image_helpers.h"

namespace pbrtmedia {
namespace {

std::string chunk(const std::string& type, const std::string& data) {
  std::string out(4, '\0');
  setWord(out, 0, static_cast<unsigned>(data.size()), 4, true);
  const std::string body = type + data;
  std::string crc(4, '\0');
  setWord(crc, 0,
          static_cast<unsigned>(
              crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()))),
          4, true);
  return out + body + crc;
}

std::string deflated(const std::string& data) {
  uLongf size = compressBound(static_cast<uLong>(data.size()));
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
           static_cast<uLong>(data.size()));
  out.resize(size);
  return out;
}

/// A PNG put together by hand. `rows` holds a filter byte 0 before each row; `extra` are chunks before IDAT.
std::string makePng(unsigned width, unsigned height, int depth, int colourType, const std::string& rows,
                    const std::string& extra = "") {
  std::string header(13, '\0');
  setWord(header, 0, width, 4, true);
  setWord(header, 4, height, 4, true);
  header[8] = static_cast<char>(depth);
  header[9] = static_cast<char>(colourType);
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + extra + chunk("IDAT", deflated(rows)) +
         chunk("IEND", "");
}

using namespace std::string_literals;

TEST(Png, ReadsEightBitColour) {
  const Image image = decodePng(asBytes(makePng(2, 1, 8, 2, "\0\xff\x00\x80\x33\x66\x99"s)), "a.png");
  EXPECT_EQ(image.channels(), (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(image.rgb(0, 0), Rgb(1, 0, 128 / 255.0f));
  EXPECT_EQ(image.rgb(1, 0), Rgb(0.2f, 0.4f, 0.6f));
}

TEST(Png, ReadsSixteenBitsWhole) {
  const Image image = decodePng(asBytes(makePng(1, 1, 16, 0, "\0\x12\x34"s)), "a.png");
  EXPECT_EQ(image.channels(), std::vector<std::string>{"Y"});
  EXPECT_EQ(image.data()[0], 0x1234 / 65535.0f);
}

TEST(Png, ExpandsGreyOfFewBits) {
  const Image one = decodePng(asBytes(makePng(3, 1, 1, 0, "\0\xa0"s)), "a.png");  // 1 0 1
  EXPECT_EQ(one.data(), (std::vector<float>{1, 0, 1}));
  const Image four = decodePng(asBytes(makePng(2, 1, 4, 0, "\0\x3f"s)), "a.png");
  EXPECT_EQ(four.data(), (std::vector<float>{3 / 15.0f, 1}));
}

TEST(Png, ExpandsPalettesAndTheirTransparency) {
  const std::string palette = chunk("PLTE", "\xff\x00\x00\x00\xff\x00"s);
  const std::string rows = "\0\x40"s;  // 2 bits each: 1, 0
  const Image opaque = decodePng(asBytes(makePng(2, 1, 2, 3, rows, palette)), "a.png");
  EXPECT_EQ(opaque.channelCount(), 3u);
  EXPECT_EQ(opaque.rgb(0, 0), Rgb(0, 1, 0));
  EXPECT_EQ(opaque.rgb(1, 0), Rgb(1, 0, 0));
  const Image clear =
      decodePng(asBytes(makePng(2, 1, 2, 3, rows, palette + chunk("tRNS", "\x33"s))), "a.png");
  EXPECT_EQ(clear.channels(), (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(clear.at(0, 0, 3), 1.0f);
  EXPECT_EQ(clear.at(1, 0, 3), 0.2f);
}

TEST(Png, ReadsGreyWithAlpha) {
  const Image image = decodePng(asBytes(makePng(1, 1, 8, 4, "\0\x33\x66"s)), "a.png");
  EXPECT_EQ(image.channels(), (std::vector<std::string>{"Y", "A"}));
  EXPECT_EQ(image.rgb(0, 0), Rgb(0.2f));
  EXPECT_EQ(image.at(0, 0, 1), 0.4f);
}

TEST(Png, ReadsInterlacedFiles) {
  // 2 x 2 with Adam7: pass 1 has (0,0), pass 6 has (1,0), pass 7 has row 1.
  std::string png = makePng(2, 2, 8, 0, "\0\x11\0\x22\0\x33\x44"s);
  std::string header = png.substr(16, 13);
  header[12] = 1;
  png = png.substr(0, 8) + chunk("IHDR", header) + png.substr(8 + 25);
  const Image image = decodePng(asBytes(png), "a.png");
  EXPECT_EQ(image.at(0, 0, 0), 0x11 / 255.0f);
  EXPECT_EQ(image.at(1, 0, 0), 0x22 / 255.0f);
  EXPECT_EQ(image.at(0, 1, 0), 0x33 / 255.0f);
  EXPECT_EQ(image.at(1, 1, 0), 0x44 / 255.0f);
}

TEST(Png, WritesSrgbBytes) {
  Image image(2, 1);
  image.data() = {0.5f, 0.18f, 1.0f, -1.0f, 0.0f, 9.0f};
  const Image back = decodePng(asBytes(encodePng(image)), "a.png");
  EXPECT_EQ(back.rgb(0, 0), Rgb(188 / 255.0f, 118 / 255.0f, 1));
  EXPECT_EQ(back.rgb(1, 0), Rgb(0, 0, 1));
}

TEST(Png, RoundTripsBytesMetadataGreyAndAlpha) {
  for (const std::vector<std::string>& channels :
       {std::vector<std::string>{"R", "G", "B"}, {"R", "G", "B", "A"}, {"Y"}, {"Y", "A"}}) {
    Image image(16, 16, channels);
    image.metadata = {{"command", "pbrt scene.pbrt"}, {"note", "na\xc3\xafve"}};
    int i = 0;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        for (std::size_t c = 0; c < channels.size(); ++c) {
          const float v = static_cast<float>(i++ % 256) / 255.0f;
          image.at(x, y, c) = channels[c] == "A" ? v : decodeSrgb(v);
        }
      }
    }
    const Image back = decodePng(asBytes(encodePng(image)), "a.png");
    ASSERT_EQ(back.channels(), channels);
    EXPECT_EQ(back.metadata, image.metadata);
    i = 0;
    for (const float v : back.data()) ASSERT_EQ(v, static_cast<float>(i++ % 256) / 255.0f);
  }
}

TEST(Png, RefusesImagesWithoutColourAndBadTextNames) {
  EXPECT_THROW(encodePng(Image(2, 2, {"u", "v"})), std::runtime_error);
  Image image(2, 2);
  image.metadata[std::string(80, 'k')] = "long";
  EXPECT_THROW(encodePng(image), std::runtime_error);
}

TEST(Png, RefusesEveryTruncation) {
  const std::string bytes = encodePng(patternImage(3, 2));
  expectPrefixesRefused(ImageFormat::Png, bytes, bytes.size());
}

TEST(Png, RefusesGiantSizesAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  expectRefused(ImageFormat::Png, makePng(900000, 900000, 8, 2, "\0\0\0\0"s), "more than");
  expectRefused(ImageFormat::Png, makePng(0x7fffffff, 1, 8, 2, "\0\0\0\0"s), "PNG: ");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

TEST(Png, RefusesBadChecksumsAndMissingRows) {
  std::string bytes = makePng(2, 2, 8, 0, "\0\x11\x22\0\x33\x44"s);
  std::string broken = bytes;
  broken[20] = static_cast<char>(broken[20] ^ 1);  // inside IHDR
  expectRefused(ImageFormat::Png, broken, "PNG: ");
  expectRefused(ImageFormat::Png, makePng(2, 2, 8, 0, "\0\x11\x22"s), "PNG: ");
}

TEST(Png, RefusesChunksLongerThanTheFile) {
  std::string text = chunk("tEXt", "key\0value"s);
  setWord(text, 0, 0x4c00000au, 4, true);
  expectRefused(ImageFormat::Png, makePng(1, 1, 8, 0, "\0\x11"s, text), "inside of a chunk");
}

TEST(Png, SurvivesByteChanges) {
  Image image = patternImage(4, 3);
  image.metadata["samples"] = "12";
  expectSurvivesByteChanges(ImageFormat::Png, encodePng(image));
}

}  // namespace
}  // namespace pbrtmedia
