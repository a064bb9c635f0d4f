// SPDX-License-Identifier: BSD-2-Clause
#include "scene/statement.h"

#include <utility>

#include "scene/number.h"

namespace pbrtmedia {
namespace {

std::string found(const Token& token) {
  if (token.kind == Token::Kind::End) return "the input ends";
  return "found " + shown(token.raw);
}

[[noreturn]] void notADirective(const TokenStream& tokens, const Token& token, const SourceLocation& at) {
  if (token.kind == Token::Kind::Unclosed) tokens.throwUnclosed(token);
  if (const auto missing = tokens.missingQuote(token)) throw *missing;
  double ignored;
  if (token.kind == Token::Kind::Word && parseDouble(token.raw, ignored) != NumberStatus::Ok) {
    throw SceneError(at, "unknown directive " + shown(token.raw) + explainUnknownDirective(token.raw));
  }
  std::string message = "found " + shown(token.raw) + ", expected a directive";
  if (token.kind == Token::Kind::Word) message += "; is it a number too many?";
  throw SceneError(at, message);
}

}  // namespace

void Statement::moveInto(Entity& entity, std::size_t which) {
  entity.type = strings[which].text;
  entity.location = at;
  entity.typeLocation = strings[which].at;
  entity.params = std::move(params);
  entity.folders = folders;
  entity.given = true;
}

std::optional<Statement> StatementReader::next() {
  if (tokens_.peek().kind == Token::Kind::End) return std::nullopt;
  const Token token = tokens_.take();
  Statement s;
  s.at = tokens_.locate(token);
  s.info = token.kind == Token::Kind::Word ? findDirective(token.raw) : nullptr;
  if (!s.info) notADirective(tokens_, token, s.at);
  s.folders = tokens_.folders(token);
  if (s.info->word) {
    const Token& word = tokens_.peek();
    s.wordAt = tokens_.locate(word);
    if (word.kind != Token::Kind::Word || findDirective(word.raw)) {
      throw SceneError(s.wordAt, std::string(s.info->name) + ": " + found(word) +
                                     ", expected All, StartTime or EndTime without quotes");
    }
    s.word = word.raw;
    tokens_.take();
  }
  if (s.info->numbers > 0) readNumbers(s);
  if (s.info->maxStrings > 0) readStrings(s);
  if (s.info->value) readValue(s);
  if (s.info->parameters) s.params = params_.parse(*s.folders);
  return s;
}

void StatementReader::readNumbers(Statement& s) {
  const std::size_t count = s.info->numbers;
  const bool bracketed = count == 16;
  const std::string expected =
      ", expected " + std::to_string(count) + " numbers " + (bracketed ? "in brackets" : "without brackets");
  const auto wrong = [&](const Token& token, const std::string& what) {
    throw SceneError(tokens_.locate(token), std::string(s.info->name) + ": " + what + expected);
  };
  if (bracketed) {
    if (tokens_.peek().kind != Token::Kind::Open) wrong(tokens_.peek(), found(tokens_.peek()));
    tokens_.take();
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Token& token = tokens_.peek();
    const bool isWord = token.kind == Token::Kind::Word;
    if (!isWord || parseDouble(token.raw, s.numbers[i]) != NumberStatus::Ok) {
      // What is infinite or no number is left to those who know what becomes of the transformation.
      NumberPrefix number;
      if (isWord) number = parseDoublePrefix(token.raw, s.numbers[i]);
      if (number.kind == NumberPrefix::Kind::Nothing) {
        if (const auto missing = tokens_.missingQuote(token)) throw *missing;
        wrong(token, found(token) + (i > 0 ? " after " + std::to_string(i) : std::string()));
      }
      params_.looseNumbers().add(tokens_.locate(token), token.raw, number);
    }
    tokens_.take();
  }
  if (bracketed) {
    if (tokens_.peek().kind != Token::Kind::Close) wrong(tokens_.peek(), found(tokens_.peek()) + " after 16");
    tokens_.take();
  }
}

void StatementReader::readValue(Statement& s) {
  const auto isValue = [](const Token& t) {
    double ignored = 0;
    return t.kind == Token::Kind::String ||
           (t.kind == Token::Kind::Word && parseDouble(t.raw, ignored) == NumberStatus::Ok);
  };
  const auto append = [&](const Token& t) {
    if (!s.value.empty()) s.value += ' ';
    s.value += t.raw;
  };
  const auto wrong = [&](const Token& t, const std::string& expected) {
    if (t.kind == Token::Kind::Unclosed) tokens_.throwUnclosed(t);
    throw SceneError(tokens_.locate(t),
                     std::string(s.info->name) + ": " + found(t) + ", expected " + expected);
  };
  const bool isBracketed = tokens_.peek().kind == Token::Kind::Open;
  if (isBracketed) append(tokens_.take());
  if (!isValue(tokens_.peek())) {
    wrong(tokens_.peek(), "the variable's value: a number, a quoted string, or several of them in brackets");
  }
  append(tokens_.take());
  if (!isBracketed) return;
  while (isValue(tokens_.peek())) append(tokens_.take());
  if (tokens_.peek().kind != Token::Kind::Close) wrong(tokens_.peek(), "numbers, quoted strings or ]");
  append(tokens_.take());
}

void StatementReader::readStrings(Statement& s) {
  while (s.strings.size() < s.info->maxStrings) {
    const Token& token = tokens_.peek();
    const SourceLocation at = tokens_.locate(token);
    if (token.kind == Token::Kind::Unclosed) tokens_.throwUnclosed(token);
    if (token.kind != Token::Kind::String) {
      if (s.strings.size() >= s.info->minStrings) return;
      if (const auto missing = tokens_.missingQuote(token)) throw *missing;
      throw SceneError(at, std::string(s.info->name) + ": " + found(token) + ", expected a quoted " +
                               std::string(s.info->strings));
    }
    s.strings.push_back({unescaped(token.raw, at), at});
    tokens_.take();
  }
}

}  // namespace pbrtmedia
