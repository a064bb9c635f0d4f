// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

// What the command lines of all programs have in common: --version, errors that begin with the program's
// name, and numbers and words whose errors tell what is known.

namespace pbrtmedia {

/// A check of an option's text: a whole number from `least` to `most`.
template <class T>
CLI::Validator wholeNumber(T least, T most) {
  static_assert(std::is_integral_v<T>);
  const auto check = [least, most](std::string& text) -> std::string {
    T value{};
    const char *begin = text.data(), *const end = begin + text.size();
    if (text.size() > 1 && *begin == '+') ++begin;
    const auto [at, status] = std::from_chars(begin, end, value);
    if (status == std::errc() && at == end && value >= least && value <= most) return {};
    const std::string from = std::to_string(least);
    return "found " + text + ", expected a whole number " +
           (most == std::numeric_limits<T>::max()
                ? "of at least " + from + ", below 2^" + std::to_string(std::numeric_limits<T>::digits)
                : "from " + from + " to " + std::to_string(most));
  };
  return CLI::Validator(check, "");
}

/// What a number may be; finite in any case.
struct NumberRange {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool excludesLeast = false;

  static constexpr NumberRange any() { return {}; }
  static constexpr NumberRange above(double x) { return {.least = x, .excludesLeast = true}; }
  static constexpr NumberRange atLeast(double x) { return {.least = x}; }
  static constexpr NumberRange between(double a, double b) { return {.least = a, .most = b}; }

  bool holds(double x) const;
  /// "a finite number above 0", "a number from 1 to 1000".
  std::string describe() const;
};

/// A check of an option's text: a number of the range.
CLI::Validator number(NumberRange range);

/// A change of an option's text (CLI::Option::transform): one of the keys, in capital letters or small ones,
/// becomes its value; another word is an error that lists the keys.
CLI::Validator oneOf(const std::map<std::string, std::string>& textOf);
/// The same for values of an enumeration or bool.
template <class T>
CLI::Validator oneOf(const std::map<std::string, T>& valueOf) {
  static_assert(std::is_enum_v<T> || std::is_same_v<T, bool>);
  std::map<std::string, std::string> textOf;
  for (const auto& [word, value] : valueOf) textOf[word] = std::to_string(static_cast<int>(value));
  return oneOf(textOf);
}
/// The same for words that stay as they are.
CLI::Validator oneOf(std::initializer_list<const char*> words);

/// A word as a shell reads it back: quoted where that is needed.
std::string shellWord(std::string_view word);

/// Parses a program's words, without its name; adds --version. Answers nothing when the program shall go on,
/// else its exit status: 0 after help or version on standard output; 1 after "name: error: what is wrong" on
/// standard error, with the nearest names where an option or a command is unknown.
std::optional<int> parseCommandLine(CLI::App& app, const std::vector<std::string>& words);

}  // namespace pbrtmedia
