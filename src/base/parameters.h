// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

namespace pbrtmedia {

/// The words for the values of an enumeration parameter, in the order of its enumerators, which count from 0.
/// Specialise for each: `template <> inline constexpr std::array kChoices<Comb>{std::string_view("..."),
/// ...}`.
template <class Enum>
inline constexpr std::array<std::string_view, 0> kChoices{};

/// One parameter of an estimator or a law: its name in scene files and in the lab, where it is stored, what
/// it means and what is allowed. T: double, an integer, bool, or an enumeration with kChoices.
template <class Owner, class T>
struct Parameter {
  std::string_view name;
  T Owner::*member;
  std::string_view help;
  double min = -std::numeric_limits<double>::infinity();  ///< numbers only; inclusive
  double max = std::numeric_limits<double>::infinity();
};
template <class Owner, class T>
Parameter(std::string_view, T Owner::*, std::string_view) -> Parameter<Owner, T>;
template <class Owner, class T>
Parameter(std::string_view, T Owner::*, std::string_view, double) -> Parameter<Owner, T>;
template <class Owner, class T>
Parameter(std::string_view, T Owner::*, std::string_view, double, double) -> Parameter<Owner, T>;

/// A value given to a parameter, before its type is known to fit.
using ParameterValue = std::variant<bool, double, std::string>;

/// What help, docs and messages say of a parameter.
struct ParameterDescription {
  std::string name;
  std::string type;     ///< PBRT's word: float, integer, bool, string
  std::string value;    ///< present value, as text: the default, for a default-constructed owner
  std::string allowed;  ///< range or words; empty: anything
  std::string help;
};

std::string formatNumber(double value);  ///< shortest text that reads back as the same double
/// The number that a float of a scene file was written as: 0.65 for 0.65f, whose double is 0.64999998.
double decimalOf(float value);
std::string textOf(const ParameterValue& value);  ///< as messages quote it

template <class Owner, class T>
ParameterDescription describe(const Owner& owner, const Parameter<Owner, T>& parameter) {
  ParameterDescription d{std::string(parameter.name), "", "", "", std::string(parameter.help)};
  const T& value = owner.*parameter.member;
  if constexpr (std::is_same_v<T, bool>) {
    d.type = "bool";
    d.value = value ? "true" : "false";
  } else if constexpr (std::is_enum_v<T>) {
    d.type = "string";
    d.value = kChoices<T>[static_cast<std::size_t>(value)];
    for (const std::string_view word : kChoices<T>) {
      if (!d.allowed.empty()) d.allowed += ", ";
      d.allowed += word;
    }
  } else {
    d.type = std::is_integral_v<T> ? "integer" : "float";
    d.value = formatNumber(static_cast<double>(value));
    const bool below = std::isfinite(parameter.min), above = std::isfinite(parameter.max);
    if (below && above) {
      d.allowed = formatNumber(parameter.min);
      d.allowed += " to ";
      d.allowed += formatNumber(parameter.max);
    } else if (below) {
      d.allowed = "at least ";
      d.allowed += formatNumber(parameter.min);
    } else if (above) {
      d.allowed = "at most ";
      d.allowed += formatNumber(parameter.max);
    }
  }
  return d;
}

/// Stores `value`; what is wrong with it otherwise ("found 3, expected 0 to 1").
template <class Owner, class T>
std::optional<std::string> assign(Owner& owner, const Parameter<Owner, T>& parameter,
                                  const ParameterValue& value) {
  T& target = owner.*parameter.member;
  const auto complain = [&](const std::string& found) {
    const ParameterDescription d = describe(owner, parameter);
    std::string text = "found ";
    text += found;
    text += ", expected ";
    text += d.type == "bool" ? "true or false" : d.type == "string" ? "one of " : "a ";
    if (d.type == "float" || d.type == "integer") text += d.type == "float" ? "number " : "whole number ";
    text += d.allowed;
    if (text.back() == ' ') text.pop_back();
    return std::optional(text);
  };
  if constexpr (std::is_same_v<T, bool>) {
    if (const bool* b = std::get_if<bool>(&value)) {
      target = *b;
      return std::nullopt;
    }
  } else if constexpr (std::is_enum_v<T>) {
    if (const std::string* word = std::get_if<std::string>(&value)) {
      for (std::size_t i = 0; i < kChoices<T>.size(); ++i) {
        if (kChoices<T>[i] == *word) {
          target = static_cast<T>(i);
          return std::nullopt;
        }
      }
    }
  } else {
    if (const double* number = std::get_if<double>(&value)) {
      const bool fits = *number >= parameter.min && *number <= parameter.max && std::isfinite(*number);
      if constexpr (std::is_integral_v<T>) {
        if (fits && *number == std::floor(*number) && std::abs(*number) <= 0x1p53 &&
            *number <= static_cast<double>(std::numeric_limits<T>::max())) {
          target = static_cast<T>(*number);
          return std::nullopt;
        }
      } else if (fits) {
        target = static_cast<T>(*number);
        return std::nullopt;
      }
    }
  }
  return complain(textOf(value));
}

/// The parameters of an owner without any.
template <class Owner>
concept HasParameters = requires {
  Owner::parameters();
};

/// An owner whose parameters depend on each other and that answers for them itself.
template <class Owner>
concept HasOwnParameters = requires(Owner& owner, std::string_view name, const ParameterValue& value) {
  owner.describe();
  owner.assign(name, value);
};

template <class Owner>
std::vector<ParameterDescription> describeParameters(const Owner& owner) {
  std::vector<ParameterDescription> all;
  if constexpr (HasOwnParameters<Owner>) {
    all = owner.describe();
  } else if constexpr (HasParameters<Owner>) {
    std::apply([&](const auto&... parameter) { (all.push_back(describe(owner, parameter)), ...); },
               Owner::parameters());
  }
  return all;
}

/// The outcome of naming a parameter and giving it a value.
struct AssignResult {
  bool known = false;                ///< the owner has a parameter of that name
  std::optional<std::string> error;  ///< what is wrong with the value
};

template <class Owner>
AssignResult assignParameter(Owner& owner, std::string_view name, const ParameterValue& value) {
  AssignResult result;
  if constexpr (HasOwnParameters<Owner>) {
    result = owner.assign(name, value);
  } else if constexpr (HasParameters<Owner>) {
    const auto tryOne = [&](const auto& parameter) {
      if (parameter.name != name) return;
      result.known = true;
      result.error = assign(owner, parameter, value);
    };
    std::apply([&](const auto&... parameter) { (tryOne(parameter), ...); }, Owner::parameters());
  }
  return result;
}

}  // namespace pbrtmedia
