// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstdint>

namespace pbrtmedia {

/// A glyph of 5 x 7 dots: rows from the top, the leftmost dot in bit 4.
using LabGlyph = std::array<std::uint8_t, 7>;
inline constexpr int kLabGlyphWidth = 5, kLabGlyphHeight = 7;

/// The glyph of an ASCII character; small letters look like capitals, what is not drawn like a box.
const LabGlyph& labGlyph(char c);

}  // namespace pbrtmedia
