// SPDX-License-Identifier: BSD-2-Clause
#include "scene/variables.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <system_error>

#include "base/diagnostics.h"
#include "base/frame_names.h"
#include "scene/lexer.h"
#include "scene/number.h"

namespace pbrtmedia {
namespace {

constexpr std::string_view kFrame = "frame";
constexpr std::size_t kMostDigits = 99;
/// Bytes of a string: far more than names of files have, and an end for strings that double each other.
constexpr std::size_t kMostText = std::size_t{1} << 16;

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// Numbers, strings and brackets, as values of parameters have them.
bool isTokens(std::string_view text) {
  Lexer lexer(text, 0, true);
  bool isOpen = false, isEmpty = true;
  double ignored = 0;
  for (Token t = lexer.next(); t.kind != Token::Kind::End; t = lexer.next()) {
    isEmpty = false;
    if (t.kind == Token::Kind::Word && parseDouble(t.raw, ignored) == NumberStatus::Ok) continue;
    if (t.kind == Token::Kind::String) continue;
    const bool opens = t.kind == Token::Kind::Open;
    if ((!opens && t.kind != Token::Kind::Close) || opens == isOpen) return false;
    isOpen = opens;
  }
  return !isEmpty && !isOpen;
}

/// Numbers as the shortest text of their value, the rest as it stands.
std::string canonical(std::string_view tokens) {
  Lexer lexer(tokens, 0, false);
  std::string text;
  for (Token t = lexer.next(); t.kind != Token::Kind::End; t = lexer.next()) {
    if (!text.empty()) text += ' ';
    double number = 0;
    if (t.kind != Token::Kind::Word || parseDouble(t.raw, number) != NumberStatus::Ok) {
      text += t.raw;
      continue;
    }
    char buffer[32];
    text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, number == 0 ? 0.0 : number).ptr);
  }
  return text;
}

std::string padded(std::string_view value, std::size_t digits, const std::string& name) {
  if (value.empty() || !std::all_of(value.begin(), value.end(), isDigit)) {
    throw std::invalid_argument("${" + name + ":" + std::to_string(digits) + "}: $" + name + " is " +
                                shown(value) + ", expected a whole number");
  }
  return std::string(digits - std::min(digits, value.size()), '0').append(value);
}

}  // namespace

bool Variables::isName(std::string_view name) {
  return !name.empty() && isLetter(name.front()) &&
         std::all_of(name.begin(), name.end(), [](char c) { return isLetter(c) || isDigit(c); });
}

std::string Variables::tokensOf(std::string_view text) {
  return isTokens(text) ? std::string(text) : inQuotes(text);
}

void Variables::set(const std::string& name, std::string_view text) {
  values_[name] = {tokensOf(text), true, false};
}

void Variables::setFrame(int frame) {
  frame_ = frame;
  values_[std::string(kFrame)] = {std::to_string(frame), true};
}

const std::string* Variables::find(std::string_view name) {
  const auto found = values_.find(name);
  if (found == values_.end()) return nullptr;
  found->second.isUsed = true;
  return &found->second.tokens;
}

std::string Variables::inString(std::string_view name, std::string_view digits) {
  const std::string* const tokens = find(name);
  if (!tokens) {
    std::string message = "no variable \"" + shown(name) + '"';
    message += suggestion(name, names());
    throw std::invalid_argument(message + "; give it a value: --define " + shown(name) + "=VALUE");
  }
  values_.find(name)->second.isInString = true;
  Lexer lexer(*tokens, 0, false);
  const Token value = lexer.next();
  const bool isString = value.kind == Token::Kind::String;
  if ((!isString && value.kind != Token::Kind::Word) || lexer.next().kind != Token::Kind::End) {
    throw std::invalid_argument("$" + std::string(name) + " is " + shown(*tokens) +
                                ", and a string has place for one word");
  }
  const std::string_view word = isString ? value.raw.substr(1, value.raw.size() - 2) : value.raw;
  if (digits.empty()) return std::string(word);
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (error != std::errc() || end != digits.data() + digits.size() || count > kMostDigits) {
    throw std::invalid_argument("found \"" + shown(digits) + "\" behind the colon, expected digits: ${" +
                                std::string(name) + ":4}");
  }
  return padded(word, count, std::string(name));
}

std::optional<std::string> Variables::expanded(std::string_view quoted) {
  std::string text, filled;
  bool isChanged = false;
  if (frame_ && hasFramePlace(std::string(quoted))) {
    quoted = filled = frameName(std::string(quoted), *frame_);
    find(kFrame);  // is used
    isChanged = true;
  }
  for (std::size_t i = 0; i < quoted.size();) {
    const std::size_t end = quoted.substr(i, 2) == "${" ? quoted.find('}', i) : quoted.npos;
    const std::string_view inside =
        end == quoted.npos ? std::string_view() : quoted.substr(i + 2, end - i - 2);
    const std::size_t colon = std::min(inside.find(':'), inside.size());
    if (!isName(inside.substr(0, colon))) {  // no variable
      text += quoted[i++];
      continue;
    }
    text += inString(inside.substr(0, colon), inside.substr(std::min(colon + 1, inside.size())));
    if (text.size() > kMostText) {
      throw std::invalid_argument("variables make the string longer than " + std::to_string(kMostText) +
                                  " bytes");
    }
    isChanged = true;
    i = end + 1;
  }
  if (!isChanged) return std::nullopt;
  return text;
}

std::vector<std::string_view> Variables::names() const {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : values_) names.push_back(name);
  return names;
}

bool Variables::isUsed(std::string_view name) const {
  const auto found = values_.find(name);
  return found != values_.end() && found->second.isUsed;
}

std::optional<double> Variables::number(std::string_view name) const {
  const auto found = values_.find(name);
  double value = 0;
  if (found == values_.end() || parseDouble(found->second.tokens, value) != NumberStatus::Ok)
    return std::nullopt;
  return value;
}

std::vector<Variables::Used> Variables::used() const {
  std::vector<Used> all;
  for (const auto& [name, value] : values_) {
    if (value.isUsed) all.push_back({name, value.isInString ? value.tokens : canonical(value.tokens)});
  }
  return all;
}

std::vector<std::string_view> Variables::unused() const {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : values_) {
    const bool isFrame = frame_ && name == kFrame;
    if (value.isGiven && !value.isUsed && !isFrame) names.push_back(name);
  }
  return names;
}

}  // namespace pbrtmedia
