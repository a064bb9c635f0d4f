// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>

#include "scene/directives.h"
#include "scene/lexer.h"
#include "scene/param_type.h"

namespace pbrtmedia {
namespace {

/// Where the second quote of a string belongs that runs into the next one: behind the name of a declaration,
/// or behind its first word.
std::size_t endOfMeant(std::string_view body) {
  std::size_t i = 0;
  if (findParamType(nextWord(body, i)) == nullptr) return i;
  nextWord(body, i);
  return i;
}

}  // namespace

std::optional<MissingQuote> findMissingQuote(std::string_view line) {
  Lexer lexer(line, 0, false);
  std::optional<MissingQuote> found;
  Token before;
  for (Token token = lexer.next(); token.kind != Token::Kind::End; token = lexer.next()) {
    const auto start = static_cast<std::size_t>(token.raw.data() - line.data());
    const std::size_t end = start + token.raw.size();
    const bool touchesQuote = end < line.size() && line[end] == '"';
    const bool touchesWord =
        end < line.size() && std::string_view(" \t\"[]#").find(line[end]) == std::string_view::npos;
    if (token.kind == Token::Kind::Unclosed) {
      if (found) return found;
      return MissingQuote{start, "the string has no closing \" on its line"};
    }
    if (!found && token.kind == Token::Kind::String && touchesWord) {
      const std::size_t meant = start + 1 + endOfMeant(token.raw.substr(1, token.raw.size() - 2));
      found = {meant, "a \" is missing here: the string goes on to the next one of the line"};
    } else if (!found && token.kind == Token::Kind::Word && touchesQuote &&
               findDirective(token.raw) == nullptr) {
      const bool isName = before.kind == Token::Kind::Word && findParamType(before.raw) != nullptr;
      const std::size_t meant = isName ? static_cast<std::size_t>(before.raw.data() - line.data()) : start;
      found = {meant, "a \" is missing here: " + shown(line.substr(meant, end + 1 - meant)) +
                          " has only its second one"};
    }
    before = token;
  }
  return std::nullopt;  // what looks odd is closed all the same
}

}  // namespace pbrtmedia
