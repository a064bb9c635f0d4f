// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pbrtmedia {

/// Names that stand for values in scene files, an extension of the language. `$name` where tokens may stand
/// is the value: a number, a string, or several of them in brackets. In quoted strings `${name}` is a value
/// of one word, `${name:4}` a whole number of at least so many digits, and while a frame is set `####` its
/// number.
///
/// A value of the command line holds from the start; `Define` gives one to a name that has none, so what is
/// defined before an Include replaces the defaults of the included file.
class Variables {
 public:
  /// A letter or _, then letters, digits, _.
  static bool isName(std::string_view name);
  /// The text as tokens of the language: numbers, strings and brackets stay, other text is a string.
  static std::string tokensOf(std::string_view text);

  /// Of the command line. `name`: isName. The last of one name counts.
  void set(const std::string& name, std::string_view text);
  /// Sets the variable "frame" too. `frame`: >= 0.
  void setFrame(int frame);
  /// `tokens`: of the language. Nothing happens where the name has a value.
  void setDefault(const std::string& name, std::string tokens) {
    values_.try_emplace(name, Value{std::move(tokens)});
  }

  /// The tokens of a value, which then counts as used; null: there is none.
  const std::string* find(std::string_view name);
  /// What a quoted string stands for when it names variables, in its quotes; nothing: it names none.
  /// Throws std::invalid_argument where a value does not fit in.
  std::optional<std::string> expanded(std::string_view quoted);

  std::vector<std::string_view> names() const;
  /// Whether something asked for it.
  bool isUsed(std::string_view name) const;
  /// The value where it is one number.
  std::optional<double> number(std::string_view name) const;
  /// What something asked for, by name, with a text that is the same for equal values: that of numbers does
  /// not depend on how they are written (1.2 and 1.20), unless a string has taken the value in.
  struct Used {
    std::string name, value;
    bool operator==(const Used&) const = default;
  };
  std::vector<Used> used() const;
  /// Names of the command line that nothing asked for. A frame may go unused.
  std::vector<std::string_view> unused() const;

 private:
  struct Value {
    std::string tokens;
    bool isGiven = false;  ///< by the command line
    bool isUsed = false;
    bool isInString = false;  ///< used there, so that it counts as text
  };
  std::string inString(std::string_view name, std::string_view digits);

  std::map<std::string, Value, std::less<>> values_;
  std::optional<int> frame_;
};

}  // namespace pbrtmedia
