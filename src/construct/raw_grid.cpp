// SPDX-License-Identifier: BSD-2-Clause
#include "construct/raw_grid.h"

#include <bit>
#include <cstddef>

namespace pbrtmedia {
namespace {

template <class Word>
Word wordAt(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = sizeof(Word); i-- > 0;)
    word = word << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
  return static_cast<Word>(word);
}

}  // namespace

float floatOfHalf(std::uint16_t bits) {
  const std::uint32_t sign = std::uint32_t{bits} >> 15 << 31, exponent = bits >> 10 & 31u,
                      mantissa = bits & 1023u;
  if (exponent == 31) return std::bit_cast<float>(sign | 0x7f800000u | mantissa << 13);
  // A subnormal half is a whole number of its spacing, 2^-24, which float holds.
  if (exponent == 0) {
    const float magnitude = static_cast<float>(mantissa) * 0x1p-24f;
    return sign != 0 ? -magnitude : magnitude;
  }
  return std::bit_cast<float>(sign | (exponent + 112) << 23 | mantissa << 13);
}

std::vector<float> decodeRaw(const FileBytes& file, RawFormat format) {
  const std::span<const std::byte> bytes = file.bytes();
  std::vector<float> numbers(bytes.size() / bytesOf(format));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = format == RawFormat::Half ? floatOfHalf(wordAt<std::uint16_t>(bytes, 2 * i))
                                           : std::bit_cast<float>(wordAt<std::uint32_t>(bytes, 4 * i));
  }
  return numbers;
}

}  // namespace pbrtmedia
