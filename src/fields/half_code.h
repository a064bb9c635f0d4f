// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace pbrtmedia {

/// IEEE 754 binary16 without its sign: 0 <= value <= 65504, 11 significant bits from 2^-14 up, steps of 2^-24
/// below. Decoding is exact, and one shift and one product, so that scalar and vector code agree by
/// construction.
struct HalfCode {
  static constexpr float kRebias = 0x1p112f;  ///< between the exponent biases 15 and 127
  static constexpr int kMantissaShift = 13;   ///< 23 - 10 bits

  static float decode(std::uint16_t code) {
    return std::bit_cast<float>(std::uint32_t{code} << kMantissaShift) * kRebias;
  }

  /// Nearest code, ties to even. `value` in [0, 65504].
  static std::uint16_t encode(double value) {
    if (value < 0x1p-14) return static_cast<std::uint16_t>(std::nearbyint(value * 0x1p24));
    const int exponent = std::ilogb(value);
    // In [1024, 2048]; 2048 carries into the exponent, which is right.
    const double mantissa = std::nearbyint(std::ldexp(value, 10 - exponent));
    return static_cast<std::uint16_t>(((exponent + 15) << 10) + static_cast<int>(mantissa) - 1024);
  }
};

}  // namespace pbrtmedia
