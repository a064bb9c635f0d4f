// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

namespace pbrtmedia::test {

/// A number as a table prints it, with the error its last digit stands for.
struct Printed {
  double value, halfUnit;

  explicit Printed(std::string_view text) : value(std::strtod(std::string(text).c_str(), nullptr)) {
    const std::size_t exponentAt = text.find('e'), pointAt = text.find('.');
    const std::string_view digits = text.substr(0, exponentAt);
    const double exponent = exponentAt == std::string_view::npos
                                ? 0
                                : std::strtod(std::string(text.substr(exponentAt + 1)).c_str(), nullptr);
    const double decimals =
        pointAt == std::string_view::npos ? 0 : static_cast<double>(digits.size() - pointAt - 1);
    halfUnit = 0.5 * std::pow(10.0, exponent - decimals);
  }
  /// `computed` rounds to what is printed; ties go either way.
  bool agreesWith(double computed) const { return std::abs(computed - value) <= halfUnit * (1 + 1e-9); }
};

}  // namespace pbrtmedia::test
