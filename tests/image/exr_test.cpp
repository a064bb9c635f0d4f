// SPDX-License-Identifier: BSD-2-Clause
#include <ImfChannelList.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfOutputFile.h>
#include <ImfPreviewImageAttribute.h>
#include <ImfRgbaFile.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTiledRgbaFile.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "image/exr_stream.h"
#include "image_helpers.h"

namespace pbrtmedia {
namespace {

Image sampleImage() {
  Image image = patternImage(21, 35);
  image.dataWindow = {{-3, 4}, {18, 39}};
  image.displayWindow = {{0, 0}, {40, 50}};
  image.metadata = {{"command", "pbrt scene.pbrt"}, {"samples", "64"}, {"note", ""}};
  return image;
}

void expectSame(const Image& a, const Image& b) {
  EXPECT_EQ(a.width(), b.width());
  EXPECT_EQ(a.height(), b.height());
  EXPECT_EQ(a.channels(), b.channels());
  EXPECT_EQ(a.data(), b.data());
  EXPECT_EQ(a.dataWindow, b.dataWindow);
  EXPECT_EQ(a.displayWindow, b.displayWindow);
  EXPECT_EQ(a.metadata, b.metadata);
}

TEST(Exr, RoundTripsInEveryTypeAndCompression) {
  const Image image = sampleImage();
  for (const PixelType type : {PixelType::Half, PixelType::Float}) {
    for (const ExrCompression compression :
         {ExrCompression::None, ExrCompression::Zip, ExrCompression::Piz}) {
      SCOPED_TRACE(::testing::Message() << static_cast<int>(type) << ' ' << static_cast<int>(compression));
      expectSame(decodeExr(asBytes(encodeExr(image, {type, compression})), "a.exr"), image);
    }
  }
}

TEST(Exr, KeepsEveryBitOfFloats) {
  Image image(4, 1, {"Y"});
  image.data() = {1.0f / 3.0f, 1e-38f, std::numeric_limits<float>::infinity(), 3e38f};
  const std::string bytes = encodeExr(image, {PixelType::Float, ExrCompression::Zip});
  EXPECT_EQ(decodeExr(asBytes(bytes), "a.exr").data(), image.data());
}

TEST(Exr, HalfRoundsAndOverflowsToInfinity) {
  Image image(3, 1, {"Y"});
  image.data() = {1.0f / 3.0f, 70000.0f, std::numeric_limits<float>::quiet_NaN()};
  const Image back = decodeExr(asBytes(encodeExr(image, {PixelType::Half, ExrCompression::None})), "a.exr");
  EXPECT_NEAR(back.data()[0], 1.0 / 3.0, 1.0 / 3.0 / 2048);
  EXPECT_NE(back.data()[0], image.data()[0]);
  EXPECT_TRUE(std::isinf(back.data()[1]));
  EXPECT_TRUE(std::isnan(back.data()[2]));
}

TEST(Exr, PutsColoursFirstAndKeepsOtherNames) {
  const Image image = patternImage(3, 2, {"Z", "B", "albedo.R", "A", "G", "R"});
  const Image back = decodeExr(asBytes(encodeExr(image, {})), "a.exr");
  EXPECT_EQ(back.channels(), (std::vector<std::string>{"R", "G", "B", "A", "Z", "albedo.R"}));
  EXPECT_EQ(back.rgb(2, 1), image.rgb(2, 1));
  EXPECT_EQ(back.at(1, 0, 4), image.at(1, 0, 0));
}

TEST(Exr, WritesTheSameBytesForTheSameImage) {
  EXPECT_EQ(encodeExr(sampleImage(), {}), encodeExr(sampleImage(), {}));
}

TEST(Exr, RefusesAWindowOfAnotherSizeAndMetadataThatCollide) {
  Image image = sampleImage();
  image.dataWindow.max.x += 1;
  EXPECT_THROW(encodeExr(image, {}), std::runtime_error);
  image = sampleImage();
  image.metadata["channels"] = "three";
  EXPECT_THROW(encodeExr(image, {}), std::runtime_error);
  image = sampleImage();
  image.metadata[""] = "nameless";
  EXPECT_THROW(encodeExr(image, {}), std::runtime_error);
}

TEST(Exr, ReadsTiles) {
  ExrMemoryOutput stream;
  std::vector<Imf::Rgba> pixels;
  for (int i = 0; i < 20 * 10; ++i) pixels.emplace_back(i, 2 * i, 0.5f, 1);
  {
    Imf::TiledRgbaOutputFile file(stream, Imf::Header(20, 10), Imf::WRITE_RGBA, 8, 4, Imf::MIPMAP_LEVELS);
    file.setFrameBuffer(pixels.data(), 1, 20);
    for (int level = 0; level < file.numLevels(); ++level) {
      file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    }
  }
  const Image image = decodeExr(asBytes(stream.take()), "tiles.exr");
  ASSERT_EQ(image.channels(), (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(image.rgb(19, 9), Rgb(199, 398, 0.5f));
  EXPECT_EQ(image.rgb(3, 2), Rgb(43, 86, 0.5f));
}

TEST(Exr, ReadsLuminanceChromaAndLuminanceOnly) {
  const std::vector<Imf::Rgba> pixels(16 * 16, Imf::Rgba(0.5f, 0.25f, 0.125f, 1));
  for (const Imf::RgbaChannels channels : {Imf::WRITE_YC, Imf::WRITE_YCA, Imf::WRITE_Y}) {
    ExrMemoryOutput stream;
    {
      Imf::RgbaOutputFile file(stream, Imf::Header(16, 16), channels);
      file.setFrameBuffer(pixels.data(), 1, 16);
      file.writePixels(16);
    }
    const Image image = decodeExr(asBytes(stream.take()), "yc.exr");
    const Rgb c = image.rgb(8, 8);
    if (channels == Imf::WRITE_Y) {
      EXPECT_EQ(image.channels(), std::vector<std::string>{"Y"});
      EXPECT_NEAR(c.g, 0.2126f * 0.5f + 0.7152f * 0.25f + 0.0722f * 0.125f, 1e-3f);
    } else {
      EXPECT_EQ(image.channelCount(), channels == Imf::WRITE_YCA ? 4u : 3u);
      EXPECT_NEAR(c.r, 0.5f, 5e-3f);
      EXPECT_NEAR(c.g, 0.25f, 5e-3f);
      EXPECT_NEAR(c.b, 0.125f, 5e-3f);
    }
  }
}

TEST(Exr, ReadsIntegerChannelsAndNamesSubsampledOnes) {
  const auto write = [](int sampling) {
    const std::vector<unsigned> ids{7, 11, 13, 17};
    ExrMemoryOutput stream;
    {
      Imf::Header header(2, 2);
      header.channels().insert("id", Imf::Channel(Imf::UINT, sampling, sampling));
      Imf::FrameBuffer frame;
      char* base = const_cast<char*>(reinterpret_cast<const char*>(ids.data()));
      frame.insert("id", Imf::Slice(Imf::UINT, base, 4, 8, sampling, sampling));
      Imf::OutputFile file(stream, header);
      file.setFrameBuffer(frame);
      file.writePixels(2);
    }
    return stream.take();
  };
  EXPECT_EQ(decodeExr(asBytes(write(1)), "id.exr").data(), (std::vector<float>{7, 11, 13, 17}));
  expectRefused(ImageFormat::Exr, write(2), "channel \"id\" is subsampled");
}

TEST(Exr, RefusesEveryTruncation) {
  Image image = patternImage(3, 2);
  image.metadata["samples"] = "1";
  const std::string bytes = encodeExr(image, {});
  expectPrefixesRefused(ImageFormat::Exr, bytes, bytes.size());
}

/// Position of the value of a header attribute.
std::size_t attribute(const std::string& bytes, const std::string& nameAndType) {
  return bytes.find(nameAndType) + nameAndType.size() + 4;
}

TEST(Exr, RefusesGiantSizesAtOnce) {
  using namespace std::string_literals;
  const std::string bytes = encodeExr(patternImage(3, 2), {});
  const std::size_t window = attribute(bytes, "dataWindow\0box2i\0"s);
  ASSERT_LT(window, bytes.size());
  for (const unsigned side : {0x7fffffffu, 0x3ffffff0u, 200000u, 20000u}) {
    SCOPED_TRACE(side);
    std::string changed = bytes;
    setWord(changed, window + 8, side, 4, false);
    setWord(changed, window + 12, side, 4, false);
    const auto start = std::chrono::steady_clock::now();
    expectRefused(ImageFormat::Exr, changed, "OpenEXR: ");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  }
}

/// A picture of one colour, as a file of one part.
std::string constantExr(int side, Imf::Compression compression) {
  ExrMemoryOutput stream;
  {
    const std::vector<half> row(3 * static_cast<std::size_t>(side), half(0.25f));
    Imf::Header header(side, side);
    header.compression() = compression;
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < 3; ++c) {
      const char* const name = c == 0 ? "R" : c == 1 ? "G" : "B";
      header.channels().insert(name, Imf::Channel(Imf::HALF));
      char* base = const_cast<char*>(reinterpret_cast<const char*>(row.data() + c));
      frame.insert(name, Imf::Slice(Imf::HALF, base, 3 * sizeof(half), 0));
    }
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(side);
  }
  return stream.take();
}

TEST(Exr, ReadsWhatPacksToTheLeastThatEveryMethodCan) {
  for (const Imf::Compression compression :
       {Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION,
        Imf::PXR24_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
    SCOPED_TRACE(static_cast<int>(compression));
    constexpr int kSide = 512;
    const Image image = decodeExr(asBytes(constantExr(kSide, compression)), "grey.exr");
    EXPECT_EQ(image.width(), kSide);
    for (const int at : {0, 255, 256, kSide - 1}) EXPECT_NEAR(image.rgb(at, at).g, 0.25f, 1e-3f);
  }
}

TEST(Exr, TakesMemoryInProportionToTheFile) {
  using namespace std::string_literals;
  std::string bytes = constantExr(64, Imf::DWAA_COMPRESSION);
  bytes.resize(33000, '\0');
  const std::size_t window = attribute(bytes, "dataWindow\0box2i\0"s);
  const auto withSide = [&](unsigned side) {
    std::string changed = bytes;
    setWord(changed, window + 8, side - 1, 4, false);
    setWord(changed, window + 12, side - 1, 4, false);
    return changed;
  };
  expectRefused(
      ImageFormat::Exr, withSide(16384),
      "the header claims 16384 x 16384 pixels of 3 channels, 3219 MB in memory; expected at most 672 MB");
  // Below the limit memory is taken as data comes: here none does.
  expectRefused(ImageFormat::Exr, withSide(7000), "OpenEXR: ");
}

TEST(Exr, RefusesAttributesLongerThanTheFile) {
  using namespace std::string_literals;
  Image image = patternImage(3, 2);
  image.metadata["samples"] = "1";
  std::string bytes = encodeExr(image, {});
  const std::size_t value = attribute(bytes, "samples\0string\0"s);
  setWord(bytes, value - 4, 0x7fffffffu, 4, false);
  expectRefused(ImageFormat::Exr, bytes, "attribute longer than the file");
}

TEST(Exr, RefusesAttributesWhoseSizeDoesNotFitTheirType) {
  using namespace std::string_literals;
  const std::string bytes = encodeExr(patternImage(3, 2), {});
  for (const std::string& name : {"dataWindow\0box2i\0"s, "channels\0chlist\0"s,
                                  "compression\0compression\0"s, "pixelAspectRatio\0float\0"s}) {
    for (const unsigned size : {0u, 3u, 17u, 55u}) {
      std::string changed = bytes;
      const std::size_t value = attribute(bytes, name);
      ASSERT_LT(value, bytes.size());
      if (static_cast<unsigned char>(changed[value - 4]) == size) continue;
      setWord(changed, value - 4, size, 4, false);
      expectRefused(ImageFormat::Exr, changed, "header");
    }
  }
}

/// An attribute put before all others; the image behind the header can no longer be found.
std::string withAttribute(std::string bytes, const std::string& type, const std::string& value) {
  using namespace std::string_literals;
  std::string attribute = "extra\0"s + type + "\0"s + std::string(4, '\0') + value;
  setWord(attribute, 6 + type.size() + 1, static_cast<unsigned>(value.size()), 4, false);
  return bytes.insert(8, attribute);
}

TEST(Exr, RefusesVariableAttributesThatDoNotFillTheirSize) {
  using namespace std::string_literals;
  const std::string bytes = encodeExr(patternImage(3, 2), {});
  const std::string wrong = "whose size does not fit its type";
  for (const auto& [type, value] : {std::pair{"stringvector"s, "\5\0\0\0abc"s},
                                    {"floatvector"s, "abc"s},
                                    {"preview"s, "\2\0\0\0\1\0\0\0abcd"s},
                                    {"preview"s, "\0\0\1\0\0\0\1\0"s},
                                    {"chlist"s, "R\0abcdefgh"s}}) {
    SCOPED_TRACE(type);
    expectRefused(ImageFormat::Exr, withAttribute(bytes, type, value), wrong);
  }
  expectRefused(ImageFormat::Exr, withAttribute(bytes, "idmanifest", "abcdefgh"),
                "attributes of type \"idmanifest\" are not supported");
}

TEST(Exr, ReadsPastAttributesOfVariableSize) {
  ExrMemoryOutput stream;
  const std::vector<Imf::Rgba> pixels(4, Imf::Rgba(0.5f, 0.25f, 0.125f, 1));
  {
    Imf::Header header(2, 2);
    header.insert("words", Imf::StringVectorAttribute({"one", "", "three"}));
    header.insert("numbers", Imf::FloatVectorAttribute({1, 2, 3}));
    header.insert("preview", Imf::PreviewImageAttribute(Imf::PreviewImage(3, 2)));
    Imf::RgbaOutputFile file(stream, header, Imf::WRITE_RGB);
    file.setFrameBuffer(pixels.data(), 1, 2);
    file.writePixels(2);
  }
  EXPECT_EQ(decodeExr(asBytes(stream.take()), "a.exr").rgb(1, 1), Rgb(0.5f, 0.25f, 0.125f));
}

TEST(Exr, ReadsEveryCompressionOfOthers) {
  for (const Imf::Compression compression :
       {Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION,
        Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
    SCOPED_TRACE(static_cast<int>(compression));
    ExrMemoryOutput stream;
    const std::vector<Imf::Rgba> pixels(64 * 48, Imf::Rgba(0.5f, 0.25f, 0.125f, 1));
    {
      Imf::Header header(64, 48);
      header.compression() = compression;
      Imf::RgbaOutputFile file(stream, header, Imf::WRITE_RGB);
      file.setFrameBuffer(pixels.data(), 1, 64);
      file.writePixels(48);
    }
    const Rgb c = decodeExr(asBytes(stream.take()), "a.exr").rgb(40, 30);
    EXPECT_NEAR(c.r, 0.5f, 5e-3f);
    EXPECT_NEAR(c.g, 0.25f, 5e-3f);
    EXPECT_NEAR(c.b, 0.125f, 5e-3f);
  }
}

TEST(Exr, RefusesDeepImagesAndTilesThatCannotBe) {
  using namespace std::string_literals;
  std::string deep = encodeExr(patternImage(3, 2), {});
  deep[5] = static_cast<char>(deep[5] | 0x08);
  expectRefused(ImageFormat::Exr, deep, "deep images are not supported");
  ExrMemoryOutput stream;
  const std::vector<Imf::Rgba> pixels(256 * 256);
  {
    Imf::TiledRgbaOutputFile file(stream, Imf::Header(256, 256), Imf::WRITE_RGBA, 64, 64, Imf::ONE_LEVEL);
    file.setFrameBuffer(pixels.data(), 1, 256);
    file.writeTiles(0, 3, 0, 3);
  }
  const std::string tiled = stream.take();
  const std::size_t sides = attribute(tiled, "tiles\0tiledesc\0"s);
  ASSERT_LT(sides, tiled.size());
  for (const auto& [side, message] : {std::pair{0x7fffffffu, "the tiles are too large"},
                                      {1u, "the table of tiles does not fit the file"}}) {
    std::string changed = tiled;
    setWord(changed, sides, side, 4, false);
    setWord(changed, sides + 4, side, 4, false);
    expectRefused(ImageFormat::Exr, changed, message);
  }
}

TEST(Exr, SurvivesByteChanges) {
  Image image = patternImage(4, 3);
  image.metadata["samples"] = "12";
  expectSurvivesByteChanges(ImageFormat::Exr, encodeExr(image, {PixelType::Half, ExrCompression::Piz}));
  expectSurvivesByteChanges(ImageFormat::Exr, encodeExr(image, {PixelType::Float, ExrCompression::Zip}));
}

TEST(Exr, RefusesOtherFiles) {
  expectRefused(ImageFormat::Exr, "hello, this is text", "not an OpenEXR file");
  expectRefused(ImageFormat::Exr, "", "not an OpenEXR file");
}

}  // namespace
}  // namespace pbrtmedia
