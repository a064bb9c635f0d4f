// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

namespace pbrtmedia {

enum class NumberStatus { Ok, NotANumber, TooLarge };

/// A decimal number taken apart: value = (negative ? -1 : 1) · mantissa · 10^exponent, if `exact`.
struct Decimal {
  std::uint64_t mantissa = 0;
  int exponent = 0;
  bool negative = false;
  bool exact = true;      ///< at most 19 digits and an exponent of moderate size
  bool isDigits = false;  ///< digits only: no sign, point or exponent
};

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
    const auto places = p - fraction;
    count += places;
    d.exact = places < 1000;
    d.exponent = d.exact ? -static_cast<int>(places) : 0;
  } else {
    d.isDigits = digits == first;
  }
  if (count == 0) return false;
  if (count > 19) d.exact = false;  // 19 digits always fit 64 bits
  d.mantissa = m;
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

/// 10^0 … 10^22: the powers of ten a double holds exactly.
inline constexpr std::array<double, 23> kPowersOfTen{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                     1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                     1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// The correctly rounded float by way of a double; false: the digits need a full conversion. Up to 2^53 the
/// mantissa is a double and one operation on exact operands gives the correctly rounded quotient or product
/// (Clinger 1990, doi:10.1145/93542.93557, section 5); beyond, rounding the mantissa first leaves the double
/// less than two spacings off. Rounding again is right unless the double lies within its error of half-way
/// between two floats, or where floats are subnormal or end.
inline bool exactFloat(const Decimal& d, float& value) {
  if (!d.exact || d.exponent < -22 || d.exponent > 22) return false;
  const auto m = static_cast<double>(d.mantissa);
  const double v = d.exponent < 0 ? m / kPowersOfTen[static_cast<std::size_t>(-d.exponent)]
                                  : m * kPowersOfTen[static_cast<std::size_t>(d.exponent)];
  constexpr std::uint64_t kDropped = (std::uint64_t{1} << 29) - 1;  // bits a float has less than a double
  constexpr std::uint64_t kHalfWay = std::uint64_t{1} << 28;
  const std::uint64_t error = d.mantissa > (std::uint64_t{1} << 53) ? 2 : 0;
  if ((std::bit_cast<std::uint64_t>(v) & kDropped) - (kHalfWay - error) <= 2 * error) return false;
  if (v != 0 && (v < 0x1p-126 || v > 0x1p127)) return false;
  value = static_cast<float>(d.negative ? -v : v);
  return true;
}

// Whole words: decimal numbers only. Correctly rounded; too small a number is 0.
NumberStatus parseFloat(std::string_view word, float& value);
NumberStatus parseDouble(std::string_view word, double& value);

}  // namespace pbrtmedia
