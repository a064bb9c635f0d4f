// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/files.h"

namespace pbrtmedia {

/// The numbers of a raw binary file: little-endian, one after the other, no header.
enum class RawFormat { Float, Half };
inline constexpr std::array<std::string_view, 2> kRawFormats = {"float", "half"};
constexpr std::size_t bytesOf(RawFormat format) { return format == RawFormat::Half ? 2 : 4; }

/// All numbers of the file; bytes left over at its end are not looked at.
std::vector<float> decodeRaw(const FileBytes& file, RawFormat format);

/// The value of an IEEE 754 half: exact, NaN and infinities included.
float floatOfHalf(std::uint16_t bits);

}  // namespace pbrtmedia
