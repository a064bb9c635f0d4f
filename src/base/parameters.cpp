// SPDX-License-Identifier: BSD-2-Clause
#include "base/parameters.h"

#include <charconv>
#include <cmath>

namespace pbrtmedia {
namespace {

using Kind = NumericParameter::Kind;

std::string allowedWords(std::span<const std::string_view> choices) {
  std::string text;
  for (const std::string_view word : choices) {
    if (!text.empty()) text += ", ";
    text += word;
  }
  return text;
}

std::string allowedRange(double min, double max) {
  const bool below = std::isfinite(min), above = std::isfinite(max);
  std::string text;
  if (below && above) {
    text = formatNumber(min);
    text += " to ";
    text += formatNumber(max);
  } else if (below) {
    text = "at least ";
    text += formatNumber(min);
  } else if (above) {
    text = "at most ";
    text += formatNumber(max);
  }
  return text;
}

std::string_view expectation(Kind kind) {
  switch (kind) {
    case Kind::Bool:
      return "true or false";
    case Kind::Choice:
      return "one of ";
    case Kind::Integer:
      return "a whole number ";
    case Kind::Float:
      break;
  }
  return "a number ";
}

/// The number that `given` stands for, where the parameter may have it.
std::optional<double> valueOf(const NumericParameter& parameter, const ParameterValue& given) {
  if (parameter.kind == Kind::Bool) {
    const bool* b = std::get_if<bool>(&given);
    return b == nullptr ? std::nullopt : std::optional(*b ? 1.0 : 0.0);
  }
  if (parameter.kind == Kind::Choice) {
    const std::string* word = std::get_if<std::string>(&given);
    for (std::size_t i = 0; word != nullptr && i < parameter.choices.size(); ++i) {
      if (parameter.choices[i] == *word) return static_cast<double>(i);
    }
    return std::nullopt;
  }
  const double* number = std::get_if<double>(&given);
  if (number == nullptr || !std::isfinite(*number)) return std::nullopt;
  if (!(*number >= parameter.min && *number <= parameter.max)) return std::nullopt;
  const bool isWhole =
      *number == std::floor(*number) && std::abs(*number) <= 0x1p53 && *number <= parameter.largest;
  return parameter.kind == Kind::Float || isWhole ? std::optional(*number) : std::nullopt;
}

}  // namespace

ParameterDescription describe(const NumericParameter& parameter) {
  ParameterDescription d{std::string(parameter.name), "", "", "", std::string(parameter.help)};
  switch (parameter.kind) {
    case Kind::Bool:
      d.type = "bool";
      d.value = parameter.value != 0 ? "true" : "false";
      break;
    case Kind::Choice:
      d.type = "string";
      d.value = parameter.choices[static_cast<std::size_t>(parameter.value)];
      d.allowed = allowedWords(parameter.choices);
      break;
    case Kind::Integer:
    case Kind::Float:
      d.type = parameter.kind == Kind::Integer ? "integer" : "float";
      d.value = formatNumber(parameter.value);
      d.allowed = allowedRange(parameter.min, parameter.max);
      break;
  }
  return d;
}

std::optional<std::string> readValue(NumericParameter& parameter, const ParameterValue& given) {
  if (const std::optional<double> value = valueOf(parameter, given)) {
    parameter.value = *value;
    return std::nullopt;
  }
  std::string text = "found ";
  text += textOf(given);
  text += ", expected ";
  text += expectation(parameter.kind);
  text += describe(parameter).allowed;
  if (text.back() == ' ') text.pop_back();
  return text;
}

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
