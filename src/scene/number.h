// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pbrtmedia {

enum class NumberStatus { Ok, NotANumber, TooLarge };

/// What a word begins with. PBRT-v3 reads numbers as C's strtof does and does not look at the rest of the
/// word.
struct NumberPrefix {
  enum class Kind { Nothing, Decimal, Hexadecimal, Infinite, NotANumber };
  Kind kind = Kind::Nothing;  ///< Infinite: `inf`, or beyond the range of the type; NotANumber: `nan`
  std::size_t length = 0;     ///< bytes that make the number
};

/// A decimal number taken apart: value = (negative ? -1 : 1) · mantissa · 10^exponent, if `exact`; else the
/// true mantissa lies above by less than 1.
struct Decimal {
  std::uint64_t mantissa = 0;
  std::int64_t exponent = 0;
  bool negative = false;
  bool exact = true;  ///< the mantissa holds all digits, else the first 19 from the first that is not 0 on
  bool isDigits = false;  ///< digits only: no sign, point or exponent
};

inline bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// For more digits than the mantissa has room for: takes the first of them. `digits` ends behind the last and
/// may hold the point; `d.exponent` is that of the last digit, and becomes that of the mantissa.
void takeFirstDigits(std::string_view digits, Decimal& d);

/// Reads sign, digits, point and exponent at `p` and moves it behind them. False (and `p` anywhere) when
/// there is no digit where one must be.
inline bool scanDecimal(const char*& p, const char* end, Decimal& d) {
  const char* const first = p;
  if (p != end && (*p == '-' || *p == '+')) {
    d.negative = *p == '-';
    ++p;
  }
  const char* const digits = p;
  std::uint64_t m = 0;
  while (p != end && static_cast<unsigned char>(*p - '0') < 10)
    m = 10 * m + static_cast<unsigned>(*p++ - '0');
  auto count = p - digits;
  if (p != end && *p == '.') {
    const char* const fraction = ++p;
    while (p != end && static_cast<unsigned char>(*p - '0') < 10)
      m = 10 * m + static_cast<unsigned>(*p++ - '0');
    d.exponent = fraction - p;
    count -= d.exponent;
  } else {
    d.isDigits = digits == first;
  }
  if (count == 0) return false;
  d.mantissa = m;
  if (count > 19) takeFirstDigits({digits, static_cast<std::size_t>(p - digits)}, d);
  if (p != end && (*p == 'e' || *p == 'E')) {
    d.isDigits = false;
    ++p;
    const bool negative = p != end && *p == '-';
    if (p != end && (*p == '-' || *p == '+')) ++p;
    const char* const start = p;
    int e = 0;
    while (p != end && static_cast<unsigned char>(*p - '0') < 10) {
      if (e < 100000) e = 10 * e + (*p - '0');
      ++p;
    }
    if (p == start) return false;
    d.exponent += negative ? -e : e;
  }
  return true;
}

/// 10^0 … 10^56, which takes 19 digits down to the smallest normal float. The first 23 are exact.
inline constexpr std::array<double, 57> kPowersOfTen{
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14,
    1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22, 1e23, 1e24, 1e25, 1e26, 1e27, 1e28, 1e29,
    1e30, 1e31, 1e32, 1e33, 1e34, 1e35, 1e36, 1e37, 1e38, 1e39, 1e40, 1e41, 1e42, 1e43, 1e44,
    1e45, 1e46, 1e47, 1e48, 1e49, 1e50, 1e51, 1e52, 1e53, 1e54, 1e55, 1e56};
inline constexpr std::int64_t kLastExactPower = 22;

/// The correctly rounded float by way of a double; false: the digits need a full conversion. With an exact
/// mantissa up to 2^53 and an exact power of ten, one operation gives the correctly rounded quotient or
/// product (Clinger 1990, doi:10.1145/93542.93557, section 5). Else rounding the mantissa, the power and the
/// result each add at most 2^-53 of the value, and digits left out 10^-18: less than four spacings of the
/// double. Rounding again is right unless the double lies within its error of half-way between two floats, or
/// where floats are subnormal or end.
inline bool exactFloat(const Decimal& d, float& value) {
  constexpr auto kMostPowers = static_cast<std::int64_t>(kPowersOfTen.size()) - 1;
  if (d.exponent < -kMostPowers || d.exponent > kMostPowers) return false;
  const std::int64_t power = d.exponent < 0 ? -d.exponent : d.exponent;
  const auto m = static_cast<double>(d.mantissa);
  const double ten = kPowersOfTen[static_cast<std::size_t>(power)];
  const double v = d.exponent < 0 ? m / ten : m * ten;
  constexpr std::uint64_t kDropped = (std::uint64_t{1} << 29) - 1;  // bits a float has less than a double
  constexpr std::uint64_t kHalfWay = std::uint64_t{1} << 28;
  constexpr std::uint64_t kError = 4;
  const std::uint64_t dropped = std::bit_cast<std::uint64_t>(v) & kDropped;
  if (dropped - (kHalfWay - kError) <= 2 * kError) {
    const bool isExact = d.exact && power <= kLastExactPower && d.mantissa <= std::uint64_t{1} << 53;
    if (!isExact || dropped == kHalfWay) return false;
  }
  if (v != 0 && (v < 0x1p-126 || v > 0x1p127)) return false;
  value = static_cast<float>(d.negative ? -v : v);
  return true;
}

// Whole words: decimal numbers only. Correctly rounded; too small a number is 0.
NumberStatus parseFloat(std::string_view word, float& value);
NumberStatus parseDouble(std::string_view word, double& value);

/// The longest beginning of a word that strtof would read: sign, decimal or hexadecimal digits, exponent, or
/// `inf`, `infinity`, `nan` in any case. `value` is infinite or NaN where the kind says so, and stays as it
/// is for `Nothing`. Correctly rounded; too small a number is 0.
NumberPrefix parseFloatPrefix(std::string_view word, float& value);
NumberPrefix parseDoublePrefix(std::string_view word, double& value);

}  // namespace pbrtmedia
