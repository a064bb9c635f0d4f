// SPDX-License-Identifier: BSD-2-Clause
#include "scene/number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

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

}  // namespace

NumberStatus parseFloat(std::string_view word, float& value) { return parse(word, value); }
NumberStatus parseDouble(std::string_view word, double& value) { return parse(word, value); }

}  // namespace pbrtmedia
