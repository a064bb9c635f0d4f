// SPDX-License-Identifier: BSD-2-Clause
#include "base/parameters.h"

#include <charconv>

namespace pbrtmedia {

std::string formatNumber(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::string textOf(const ParameterValue& value) {
  if (const bool* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
  if (const double* number = std::get_if<double>(&value)) return formatNumber(*number);
  std::string quoted = "\"";
  quoted += std::get<std::string>(value);
  quoted += '"';
  return quoted;
}

double decimalOf(float value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double decimal = 0;
  std::from_chars(text, end, decimal);
  return decimal;
}

}  // namespace pbrtmedia
