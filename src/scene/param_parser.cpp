// SPDX-License-Identifier: BSD-2-Clause
#include "scene/param_parser.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "scene/directives.h"
#include "scene/number.h"
#include "scene/param_parser_values.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kMaxParams = 4096;  // per directive: real ones take some twenty

}  // namespace

ParamParser::ParamParser(TokenStream& tokens, Diagnostics& diagnostics, bool readFiles)
    : tokens_(tokens), diagnostics_(diagnostics), spectra_(diagnostics, readFiles), loose_(diagnostics) {}

std::string ParamParser::whatOf(const Values& v) { return "parameter " + inQuotes(v.declaration) + ": "; }

void ParamParser::problem(const Values& v, const SourceLocation& at, const std::string& message) {
  diagnostics_.error(at, whatOf(v) + message);
}

void ParamParser::toleratedProblem(Values& v, const SourceLocation& at, const std::string& found,
                                   std::string_view consequence) {
  diagnostics_.tolerated(at, (whatOf(v) + found).append(consequence));
  addMisread(v, at, found);
}

SpectrumValues::Tolerate ParamParser::tolerateIn(Values& v) {
  return [this, &v](const SourceLocation& at, const std::string& found, std::string_view consequence) {
    toleratedProblem(v, at, found, consequence);
  };
}

void ParamParser::addMisread(Values& v, const SourceLocation& at, const std::string& found) {
  if (!v.misread) v.misread = {v.param.name, at, found};
}

void ParamParser::checkQuotes(const Token& token) const {
  if (const auto missing = tokens_.missingQuote(token)) throw *missing;
}

ParamList ParamParser::parse(const InputFolders& folders) {
  ParamList list;
  std::size_t declarations = 0;
  while (tokens_.peek().kind == Token::Kind::String || tokens_.peek().kind == Token::Kind::Unclosed) {
    if (++declarations > kMaxParams) {
      throw SceneError(tokens_.locate(tokens_.peek()),
                       "more than " + std::to_string(kMaxParams) + " parameters in one directive");
    }
    parseOne(folders, list);
  }
  return list;
}

void ParamParser::parseOne(const InputFolders& folders, ParamList& list) {
  Values v;
  const Token declaration = tokens_.take();
  v.param.declaredAt = v.param.valuesAt = tokens_.locate(declaration);
  if (declaration.kind == Token::Kind::Unclosed) tokens_.throwUnclosed(declaration);
  const std::string text = unescaped(declaration.raw, v.param.declaredAt);
  std::size_t i = 0;
  const std::string typeName(nextWord(text, i));
  v.param.name = nextWord(text, i);
  const std::string extra(nextWord(text, i));
  v.type = findParamType(typeName);
  v.declaration = shown(text);
  if (v.param.name.empty() || !v.type || !extra.empty()) checkQuotes(declaration);
  if (v.param.name.empty()) {
    diagnostics_.tolerated(v.param.declaredAt,
                           "found " + inQuotes(v.declaration) +
                               ", expected a parameter \"type name\", such as \"float fov\"; it is left out, "
                               "as in PBRT-v3");
    v.type = nullptr;
  } else if (!v.type) {
    toleratedProblem(v, v.param.declaredAt, "unknown type \"" + shown(typeName) + '"',
                     ", left out as in PBRT-v3" + suggestParamType(typeName));
  } else if (!extra.empty()) {
    toleratedProblem(v, v.param.declaredAt, "found " + inQuotes(shown(extra)) + " after the name",
                     ", which PBRT-v3 ignores");
  }

  if (tokens_.peek().kind == Token::Kind::Open) {
    v.param.valuesAt = tokens_.locate(tokens_.take());
    v.bracketed = true;
  }
  const bool good = parseValues(folders, v);
  if (v.misread) list.addMisread(*std::move(v.misread));
  if (!good) return;
  if (list.find(v.param.kind, v.param.name)) {
    diagnostics_.warning(v.param.declaredAt,
                         whatOf(v) + "given before in this directive; the last one counts");
  }
  list.add(std::move(v.param));
}

/// Throws SceneError where no value can follow.
void ParamParser::checkFirstValue(const Token& first, const Values& v) const {
  const SourceLocation at = tokens_.locate(first);
  const std::string what = whatOf(v);
  if (first.kind == Token::Kind::Unclosed) tokens_.throwUnclosed(first);
  if (first.kind == Token::Kind::End) throw SceneError(at, what + "the input ends where a value is expected");
  if (first.kind == Token::Kind::Open || (first.kind == Token::Kind::Close && !v.bracketed)) {
    throw SceneError(at, what + "found " + shown(first.raw) + ", expected a value");
  }
  if (first.kind == Token::Kind::String && !v.type->words && looksLikeDeclaration(first.raw)) {
    throw SceneError(v.param.declaredAt, what + "no value follows");
  }
  if (first.kind == Token::Kind::Word && findDirective(first.raw)) {
    throw SceneError(at, what + "found the directive " + shown(first.raw) + ", expected a value");
  }
}

/// Whether the first value is quoted or bare as the type wants it; reports it if not.
bool ParamParser::isOfType(const Token& first, Values& v) {
  const bool strings = first.kind == Token::Kind::String;
  if (strings == v.type->words || (strings && v.type->spectral == ParamType::Spectral::Samples)) return true;
  float ignored;
  const bool isNumber = first.kind == Token::Kind::Word &&
                        parseFloatPrefix(first.raw, ignored).kind != NumberPrefix::Kind::Nothing;
  const std::string expected = v.type->kind == ParamKind::Bool ? "\"true\" or \"false\" with quotes"
                               : v.type->words                 ? "a quoted string"
                                                               : "a number";
  const std::string message = "found " + shown(first.raw) + ", expected " + expected;
  if (strings || isNumber) {
    toleratedProblem(v, tokens_.locate(first), message, "; the parameter is left out, as in PBRT-v3");
  } else {
    checkQuotes(first);
    problem(v, tokens_.locate(first), message);
  }
  return false;
}

bool ParamParser::parseValues(const InputFolders& folders, Values& v) {
  if (!v.type) {
    skipValues(v.bracketed);
    return false;
  }
  v.param.kind = v.type->kind;
  v.param.tokensPerElement = v.type->perElement;

  const Token first = tokens_.peek();
  checkFirstValue(first, v);
  const bool isEmpty = first.kind == Token::Kind::Close;
  const bool strings = first.kind == Token::Kind::String;
  if (!isEmpty) v.param.valuesAt = tokens_.locate(first);
  if (!isEmpty && !isOfType(first, v)) {
    skipValues(v.bracketed);
    return false;
  }
  bool good;
  if (strings || (isEmpty && v.type->words)) {
    good =
        readStrings(v) && (v.type->words || spectra_.fromFiles(v.param, folders, whatOf(v), tolerateIn(v)));
  } else {
    good = readNumbers(v);
  }
  if (v.param.marks.size() == 1) v.param.marks = {};
  if (!v.bracketed && tokens_.peek().kind == Token::Kind::Word && looksLikeNumber(tokens_.peek().raw)) {
    throw SceneError(tokens_.locate(tokens_.peek()), whatOf(v) + "several values need brackets: [ … ]");
  }
  return good;
}

bool ParamParser::readStrings(Values& v) {
  std::vector<std::string> strings;
  for (;;) {
    const Token& next = tokens_.peek();
    if (next.kind == Token::Kind::Close && v.bracketed) {
      tokens_.take();
      break;
    }
    const SourceLocation at = tokens_.locate(next);
    if (next.kind == Token::Kind::Unclosed) tokens_.throwUnclosed(next);
    if (next.kind != Token::Kind::String) {
      const std::string found = next.kind == Token::Kind::End ? "the input ends" : "found " + shown(next.raw);
      const bool missing = next.kind == Token::Kind::End || findDirective(next.raw);
      problem(v, at, found + " among strings" + (missing ? "; is a ] missing?" : ""));
      skipValues(true);
      return false;
    }
    const Token token = tokens_.take();
    strings.push_back(unescaped(token.raw, at));
    if (v.count++ < Param::kMaxMarks) v.param.marks.push_back({token.line, token.column, token.length()});
    if (!v.bracketed) break;
  }
  if (v.type->kind == ParamKind::Texture && strings.size() != 1) {
    toleratedProblem(v, v.param.valuesAt, "found " + std::to_string(strings.size()) + " names, expected one",
                     "; the parameter is left out, as in PBRT-v3");
    return false;
  }
  if (v.type->kind != ParamKind::Bool) {
    v.param.values = std::move(strings);
    return true;
  }
  auto& bools = v.param.values.emplace<std::vector<std::uint8_t>>();
  for (const std::string& s : strings) {
    if (s != "true" && s != "false") {
      toleratedProblem(v, v.param.locationOf(bools.size()),
                       "found " + inQuotes(shown(s)) + R"(, expected "true" or "false")",
                       "; PBRT-v3 takes it as false");
    }
    bools.push_back(s == "true" ? 1 : 0);
  }
  return true;
}

/// Goes behind the values of a parameter that is left out: behind the bracket, or one value; never into what
/// looks like the next parameter or directive.
void ParamParser::skipValues(bool bracketed) {
  for (;;) {
    const Token& next = tokens_.peek();
    if (next.kind == Token::Kind::End || next.kind == Token::Kind::Unclosed) return;
    if (next.kind == Token::Kind::Word && findDirective(next.raw)) return;
    if (next.kind == Token::Kind::String && looksLikeDeclaration(next.raw)) return;
    if (!bracketed && next.kind == Token::Kind::Close) return;
    const bool isClose = tokens_.take().kind == Token::Kind::Close;
    if (isClose || !bracketed) return;
  }
}

}  // namespace pbrtmedia
