// SPDX-License-Identifier: BSD-2-Clause
#include "scene/number.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <system_error>

namespace pbrtmedia {
namespace {

/// Whether a number that its type cannot hold is too large rather than too small: looks at the power of ten
/// of the first digit that is not 0.
bool isLarge(std::string_view word) {
  const std::size_t e = word.find_first_of("eE");
  const std::string_view digits = word.substr(0, e);
  const std::size_t first = digits.find_first_of("123456789");
  if (first == digits.npos) return false;
  const auto point = static_cast<std::int64_t>(std::min(digits.find('.'), digits.size()));
  const auto place = static_cast<std::int64_t>(first);
  std::int64_t power = place < point ? point - place - 1 : point - place;
  if (e != word.npos) {
    std::int64_t exponent = 0;
    for (const char c : word.substr(e + 1)) {
      if (c >= '0' && c <= '9' && exponent < std::int64_t{1} << 50) exponent = 10 * exponent + (c - '0');
    }
    power += word[e + 1] == '-' ? -exponent : exponent;
  }
  return power > 0;
}

/// The number that the eight characters at `p` make; false when one is no digit.
bool readEightDigits(const char* p, std::uint64_t& number) {
  constexpr std::uint64_t kEach = 0x0101010101010101;
  std::uint64_t n;
  std::memcpy(&n, p, sizeof n);
  if constexpr (std::endian::native == std::endian::big) n = __builtin_bswap64(n);
  n ^= kEach * '0';  // digits become 0 to 9
  if (((((n & (kEach * 0x7f)) + kEach * (0x80 - 10)) | n) & (kEach * 0x80)) != 0) return false;
  // The first character is in the lowest byte. Neighbours join to numbers below 100, then 10^4, then 10^8.
  n = (n * 10 + (n >> 8)) & 0x00ff00ff00ff00ff;
  n = (n * 100 + (n >> 16)) & 0x0000ffff0000ffff;
  number = (n * 10000 + (n >> 32)) & 0xffffffff;
  return true;
}

template <class T>
NumberStatus parse(std::string_view word, T& value) {
  const char* p = word.data();
  Decimal d;
  if (!scanDecimal(p, word.data() + word.size(), d) || p != word.data() + word.size()) {
    return NumberStatus::NotANumber;
  }
  if (word[0] == '+') word.remove_prefix(1);
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) {
    if (isLarge(word)) return NumberStatus::TooLarge;
    value = d.negative ? T(-0.0) : T(0);
    return NumberStatus::Ok;
  }
  return error == std::errc() && std::isfinite(value) ? NumberStatus::Ok : NumberStatus::NotANumber;
}

bool isHexDigit(char c) { return isDigit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }
char lower(char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); }

/// How many bytes of `word` from `at` on are digits with at most one point; 0 when none is a digit.
template <class IsDigit>
std::size_t digitsLength(std::string_view word, std::size_t at, const IsDigit& is) {
  std::size_t i = at, digits = 0;
  bool point = false;
  for (; i < word.size(); ++i) {
    if (is(word[i])) {
      ++digits;
    } else if (word[i] == '.' && !point) {
      point = true;
    } else {
      break;
    }
  }
  return digits == 0 ? 0 : i - at;
}

/// Bytes of an exponent at `at` with its letter; 0 when it has no digit.
std::size_t exponentLength(std::string_view word, std::size_t at, char letter) {
  if (at >= word.size() || lower(word[at]) != letter) return 0;
  std::size_t i = at + 1;
  if (i < word.size() && (word[i] == '-' || word[i] == '+')) ++i;
  const std::size_t first = i;
  while (i < word.size() && isDigit(word[i])) ++i;
  return i == first ? 0 : i - at;
}

template <class T>
NumberPrefix parsePrefix(std::string_view word, T& value) {
  using Kind = NumberPrefix::Kind;
  const bool negative = !word.empty() && word[0] == '-';
  const std::size_t sign = !word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0;
  const auto signedValue = [&](T x) { return negative ? -x : x; };
  const auto starts = [&](std::string_view text) {
    return word.size() >= sign + text.size() &&
           std::equal(text.begin(), text.end(), word.begin() + static_cast<std::ptrdiff_t>(sign),
                      [](char a, char b) { return a == lower(b); });
  };
  constexpr T kInfinity = std::numeric_limits<T>::infinity();
  if (starts("inf")) {
    value = signedValue(kInfinity);
    return {Kind::Infinite, sign + (starts("infinity") ? 8 : 3)};
  }
  if (starts("nan")) {
    value = std::numeric_limits<T>::quiet_NaN();
    return {Kind::NotANumber, sign + 3};
  }
  if (starts("0x")) {
    const std::size_t digits = digitsLength(word, sign + 2, isHexDigit);
    if (digits > 0) {
      const std::size_t length = sign + 2 + digits + exponentLength(word, sign + 2 + digits, 'p');
      T magnitude = 0;
      const auto error =
          std::from_chars(word.data() + sign + 2, word.data() + length, magnitude, std::chars_format::hex).ec;
      if (error == std::errc::result_out_of_range) {
        // A hexadecimal number is too large or too small by its exponent alone, or by very many digits.
        const std::size_t p = word.find_first_of("pP");
        const bool isSmall = p < length && word[p + 1] == '-';
        value = signedValue(isSmall ? T(0) : kInfinity);
        return {isSmall ? Kind::Hexadecimal : Kind::Infinite, length};
      }
      value = signedValue(magnitude);
      return {Kind::Hexadecimal, length};
    }
  }
  const std::size_t digits = digitsLength(word, sign, isDigit);
  if (digits == 0) return {};
  const std::size_t length = sign + digits + exponentLength(word, sign + digits, 'e');
  if (parse(word.substr(0, length), value) == NumberStatus::TooLarge) {
    value = signedValue(kInfinity);
    return {Kind::Infinite, length};
  }
  return {Kind::Decimal, length};
}

}  // namespace

void takeFirstDigits(std::string_view digits, Decimal& d) {
  constexpr std::uint64_t kRoomForEight = 100'000'000'000, kRoomForOne = 1'000'000'000'000'000'000;
  const char* p = digits.data();
  const char* const end = p + digits.size();
  while (p != end && (*p == '0' || *p == '.')) ++p;
  std::uint64_t m = 0, eight;
  while (p != end && m < kRoomForOne) {
    if (*p == '.') {
      ++p;
    } else if (end - p >= 8 && m < kRoomForEight && readEightDigits(p, eight)) {
      m = 100'000'000 * m + eight;
      p += 8;
    } else {
      m = 10 * m + static_cast<unsigned>(*p++ - '0');
    }
  }
  const std::string_view left(p, static_cast<std::size_t>(end - p));
  d.mantissa = m;
  d.exact = left.empty();
  d.exponent += static_cast<std::int64_t>(left.size()) - std::count(left.begin(), left.end(), '.');
}

NumberStatus parseFloat(std::string_view word, float& value) { return parse(word, value); }
NumberStatus parseDouble(std::string_view word, double& value) { return parse(word, value); }

NumberPrefix parseFloatPrefix(std::string_view word, float& value) { return parsePrefix(word, value); }
NumberPrefix parseDoublePrefix(std::string_view word, double& value) { return parsePrefix(word, value); }

}  // namespace pbrtmedia
