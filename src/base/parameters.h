// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
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

/// A parameter of any owner and type, with its value: what describes and reads parameters is compiled once.
struct NumericParameter {
  enum class Kind { Bool, Choice, Integer, Float };
  std::string_view name;
  std::string_view help;
  Kind kind = Kind::Float;
  double value = 0;                             ///< of a bool 0 or 1, of a choice its place among `choices`
  double min = 0;                               ///< as Parameter::min
  double max = 0;                               ///< as Parameter::max
  double largest = 0;                           ///< that an integer can hold
  std::span<const std::string_view> choices{};  ///< outlive this
};

ParameterDescription describe(const NumericParameter& parameter);
/// Reads `given` into `parameter.value`; what is wrong with it otherwise ("found 3, expected 0 to 1").
std::optional<std::string> readValue(NumericParameter& parameter, const ParameterValue& given);

template <class Owner, class T>
NumericParameter numericOf(const Owner& owner, const Parameter<Owner, T>& parameter) {
  using Kind = NumericParameter::Kind;
  NumericParameter numeric{.name = parameter.name,
                           .help = parameter.help,
                           .value = static_cast<double>(owner.*parameter.member),
                           .min = parameter.min,
                           .max = parameter.max};
  if constexpr (std::is_same_v<T, bool>) {
    numeric.kind = Kind::Bool;
  } else if constexpr (std::is_enum_v<T>) {
    numeric.kind = Kind::Choice;
    numeric.choices = kChoices<T>;
  } else if constexpr (std::is_integral_v<T>) {
    numeric.kind = Kind::Integer;
    numeric.largest = static_cast<double>(std::numeric_limits<T>::max());
  }
  return numeric;
}

/// Stores `value`; what is wrong with it otherwise.
template <class Owner, class T>
std::optional<std::string> assign(Owner& owner, const Parameter<Owner, T>& parameter,
                                  const ParameterValue& value) {
  NumericParameter numeric = numericOf(owner, parameter);
  std::optional<std::string> error = readValue(numeric, value);
  if (!error) owner.*parameter.member = static_cast<T>(numeric.value);
  return error;
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
    std::apply([&](const auto&... parameter) { (all.push_back(describe(numericOf(owner, parameter))), ...); },
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
