// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace pbrtmedia {

/// Bytes that the float pixels of an image may take: 512 MiB, and 4096 for each byte of its file. Enough for
/// a picture of one colour of 8192 x 8192 pixels by any method of compression; a small file cannot take all
/// the memory there is.
constexpr std::uint64_t mostImageMemory(std::uint64_t fileBytes) {
  constexpr std::uint64_t kAlways = std::uint64_t{512} << 20, kPerByte = 4096;
  return kAlways + kPerByte * fileBytes;
}

/// What is wrong with the size that a header claims; "" when it is within `mostImageMemory`. Sides below
/// 2^31.
inline std::string excessOf(std::uint64_t width, std::uint64_t height, std::uint64_t channels,
                            std::uint64_t fileBytes) {
  const std::uint64_t most = mostImageMemory(fileBytes);
  if (width * height <= most / (channels * sizeof(float))) return {};
  return "the header claims " + std::to_string(width) + " x " + std::to_string(height) + " pixels of " +
         std::to_string(channels) + " channels, " +
         std::to_string(width * height * sizeof(float) / 1000000 * channels) +
         " MB in memory; expected at most " + std::to_string(most / 1000000) + " MB from a file of " +
         std::to_string(fileBytes) + " bytes";
}

}  // namespace pbrtmedia
