// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string>

#include "base/diagnostics.h"
#include "image/codecs.h"

namespace pbrtmedia {

inline std::span<const std::byte> asBytes(const std::string& s) {
  return {reinterpret_cast<const std::byte*>(s.data()), s.size()};
}

/// A small image of many different values, some negative, some large; all are exact as half.
inline Image patternImage(int width, int height, std::vector<std::string> channels = {"R", "G", "B"}) {
  Image image(width, height, std::move(channels));
  int i = 0;
  for (float& v : image.data()) v = static_cast<float>((i++ * 37) % 256 - 16) / 64.0f;
  return image;
}

/// Decodes and expects a SceneError that names the file and says `part`.
inline void expectRefused(ImageFormat format, const std::string& bytes, const std::string& part) {
  try {
    decodeImage(format, asBytes(bytes), "some/file.img");
    ADD_FAILURE() << "accepted; expected an error with \"" << part << "\"";
  } catch (const SceneError& e) {
    ASSERT_TRUE(e.location().file);
    EXPECT_EQ(*e.location().file, "some/file.img");
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

/// Every proper prefix of a file is refused, up to `last` (the bytes a decoder needs).
inline void expectPrefixesRefused(ImageFormat format, const std::string& bytes, std::size_t last) {
  for (std::size_t n = 0; n < last; ++n) {
    EXPECT_THROW(decodeImage(format, asBytes(bytes.substr(0, n)), "x"), SceneError) << "prefix of " << n;
  }
}

/// Files with one byte changed either decode or are refused with a SceneError; nothing else happens.
inline void expectSurvivesByteChanges(ImageFormat format, const std::string& bytes) {
  int decoded = 0, refused = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const unsigned mask : {0x01u, 0x80u, 0xffu}) {
      std::string changed = bytes;
      changed[i] = static_cast<char>(static_cast<unsigned char>(changed[i]) ^ mask);
      try {
        const Image image = decodeImage(format, asBytes(changed), "x");
        EXPECT_EQ(image.data().size(), static_cast<std::size_t>(image.width()) *
                                           static_cast<std::size_t>(image.height()) * image.channelCount());
        ++decoded;
      } catch (const SceneError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 0) << decoded << " decoded";
}

inline void setWord(std::string& bytes, std::size_t at, unsigned value, std::size_t count, bool bigEndian) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t shift = 8 * (bigEndian ? count - 1 - i : i);
    bytes[at + i] = static_cast<char>((value >> shift) & 255u);
  }
}

}  // namespace pbrtmedia
