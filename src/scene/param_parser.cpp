// SPDX-License-Identifier: BSD-2-Clause
#include "scene/param_parser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "scene/directives.h"
#include "scene/number.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kBlock = 6144;      // numbers converted at once; a multiple of every element size
constexpr std::size_t kMaxParams = 4096;  // per directive: real ones take some twenty

}  // namespace

struct ParamParser::Values {
  const ParamType* type = nullptr;
  std::string declaration;  ///< "float fov"
  Param param;
  bool bracketed = false;
  std::size_t count = 0;  ///< tokens read
  /// The first number beyond all bounds, and where it stands.
  std::string infinite;
  SourceLocation infiniteAt;
  std::optional<ParamList::Misread> misread;  ///< the first
};

ParamParser::ParamParser(TokenStream& tokens, Diagnostics& diagnostics, bool readFiles)
    : tokens_(tokens), diagnostics_(diagnostics), spectra_(diagnostics, readFiles), loose_(diagnostics) {
  floatBlock_.reserve(kBlock);
  intBlock_.reserve(kBlock);
}

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

bool ParamParser::parseValues(const InputFolders& folders, Values& v) {
  if (!v.type) {
    skipValues(v.bracketed);
    return false;
  }
  v.param.kind = v.type->kind;
  v.param.tokensPerElement = v.type->perElement;

  const Token& first = tokens_.peek();
  const SourceLocation firstAt = tokens_.locate(first);
  const std::string what = whatOf(v);
  const bool strings = first.kind == Token::Kind::String;
  if (first.kind == Token::Kind::Unclosed) tokens_.throwUnclosed(first);
  if (first.kind == Token::Kind::End)
    throw SceneError(firstAt, what + "the input ends where a value is expected");
  if (first.kind == Token::Kind::Open || (first.kind == Token::Kind::Close && !v.bracketed)) {
    throw SceneError(firstAt, what + "found " + shown(first.raw) + ", expected a value");
  }
  const bool isEmpty = first.kind == Token::Kind::Close;
  if (!isEmpty) v.param.valuesAt = firstAt;
  if (!isEmpty && strings && !v.type->words && looksLikeDeclaration(first.raw)) {
    throw SceneError(v.param.declaredAt, what + "no value follows");
  }
  if (first.kind == Token::Kind::Word && findDirective(first.raw)) {
    throw SceneError(firstAt, what + "found the directive " + shown(first.raw) + ", expected a value");
  }
  if (!isEmpty && strings != v.type->words &&
      !(strings && v.type->spectral == ParamType::Spectral::Samples)) {
    float ignored;
    const bool isNumber = first.kind == Token::Kind::Word &&
                          parseFloatPrefix(first.raw, ignored).kind != NumberPrefix::Kind::Nothing;
    const std::string expected = v.type->kind == ParamKind::Bool ? "\"true\" or \"false\" with quotes"
                                 : v.type->words                 ? "a quoted string"
                                                                 : "a number";
    const std::string message = "found " + shown(first.raw) + ", expected " + expected;
    if (strings || isNumber) {
      toleratedProblem(v, firstAt, message, "; the parameter is left out, as in PBRT-v3");
    } else {
      checkQuotes(first);
      problem(v, firstAt, message);
    }
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
    throw SceneError(tokens_.locate(tokens_.peek()), what + "several values need brackets: [ … ]");
  }
  return good;
}

/// One token as a number, by PBRT-v3's rule where it is none of ours.
template <class T>
bool ParamParser::appendNumber(Values& v, const Token& token, std::vector<T>& block) {
  constexpr bool kIsFloat = std::is_same_v<T, float>;
  using Kind = NumberPrefix::Kind;
  if constexpr (kIsFloat) {
    float value;
    if (parseFloat(token.raw, value) == NumberStatus::Ok) {
      block.push_back(value);
      return true;
    }
  }
  const SourceLocation at = tokens_.locate(token);
  std::conditional_t<kIsFloat, float, double> value = 0;
  NumberPrefix number;
  if constexpr (kIsFloat) {
    number = parseFloatPrefix(token.raw, value);
  } else {
    number = parseDoublePrefix(token.raw, value);
    if (number.kind != Kind::NotANumber && std::abs(std::trunc(value)) > 2147483647.0 &&
        value != -2147483648.0)
      number.kind = Kind::Infinite;
  }
  if (number.kind == Kind::Nothing) checkQuotes(token);
  const bool mayBeInfinite = v.type->kind == ParamKind::Float;
  if (number.kind == Kind::Nothing || number.kind == Kind::NotANumber ||
      (number.kind == Kind::Infinite && !mayBeInfinite)) {
    problem(v, at, wrongNumber(token.raw, number.kind));
    return false;
  }
  if (number.kind == Kind::Infinite && v.infinite.empty()) {
    v.infinite = shown(token.raw);
    v.infiniteAt = at;
  }
  loose_.add(at, token.raw, number);
  if constexpr (kIsFloat) {
    block.push_back(value);
  } else {
    if (value != std::trunc(value)) {
      loose_.addFraction(at, token.raw);
      addMisread(v, at, "found " + shown(token.raw) + ", expected a whole number");
    }
    block.push_back(static_cast<int>(value));
  }
  return true;
}

/// Reads numbers up to the closing bracket, handing them to `sink(pointer, count)` in blocks; every block but
/// the last is full.
template <class T, class Sink>
bool ParamParser::collect(Values& v, std::vector<T>& block, Sink&& sink) {
  block.clear();
  const auto flush = [&] {
    sink(block.data(), block.size());
    block.clear();
  };
  for (;;) {
    if (v.bracketed && v.count >= Param::kMaxMarks) {
      const std::size_t had = block.size();
      block.resize(kBlock);
      std::size_t got;
      if constexpr (std::is_same_v<T, float>) {
        got = tokens_.readFloats(block.data() + had, kBlock - had);
      } else {
        got = tokens_.readInts(block.data() + had, kBlock - had);
      }
      block.resize(had + got);
      v.count += got;
      if (block.size() == kBlock) {
        flush();
        continue;
      }
    }
    const Token& next = tokens_.peek();
    if (next.kind == Token::Kind::Close) {
      tokens_.take();
      break;
    }
    if (next.kind != Token::Kind::Word || findDirective(next.raw)) {
      const SourceLocation at = tokens_.locate(next);
      const std::string found = next.kind == Token::Kind::End ? "the input ends" : "found " + shown(next.raw);
      const bool missing =
          next.kind == Token::Kind::End || next.kind == Token::Kind::Word || looksLikeDeclaration(next.raw);
      problem(v, at, found + " among numbers" + (missing ? "; is a ] missing?" : ""));
      skipValues(true);
      return false;
    }
    const Token token = tokens_.take();
    if (!appendNumber(v, token, block)) {
      skipValues(v.bracketed);
      return false;
    }
    if (v.count++ < Param::kMaxMarks) v.param.marks.push_back({token.line, token.column, token.length()});
    if (block.size() == kBlock) flush();
    if (!v.bracketed) break;
  }
  flush();
  return true;
}

namespace {

/// Appends the whole elements of a block.
template <class V>
auto elements(std::vector<V>& out, std::uint32_t per) {
  return [&out, per](const float* numbers, std::size_t count) {
    for (std::size_t i = 0; i + per <= count; i += per) {
      if constexpr (std::is_same_v<V, Point2f>) {
        out.push_back({numbers[i], numbers[i + 1]});
      } else {
        out.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
      }
    }
  };
}

template <class T>
auto appender(std::vector<T>& out) {
  return [&out](const T* numbers, std::size_t count) { out.insert(out.end(), numbers, numbers + count); };
}

}  // namespace

bool ParamParser::readNumbers(Values& v) {
  bool good;
  std::vector<float> spectral;
  switch (v.type->kind) {
    case ParamKind::Integer:
      good = collect(v, intBlock_, appender(v.param.values.emplace<std::vector<int>>()));
      break;
    case ParamKind::Float:
      good = collect(v, floatBlock_, appender(v.param.values.emplace<std::vector<float>>()));
      break;
    case ParamKind::Point2:
    case ParamKind::Vector2:
      good = collect(v, floatBlock_, elements(v.param.values.emplace<std::vector<Point2f>>(), 2));
      break;
    case ParamKind::Spectrum:
      good = collect(v, floatBlock_, appender(spectral));
      break;
    default:
      good = collect(v, floatBlock_, elements(v.param.values.emplace<std::vector<Point3f>>(), 3));
      break;
  }
  if (!good || !settleInfinity(v)) return false;
  if (const std::size_t excess = v.count % v.type->perElement; excess != 0) {
    toleratedProblem(v, v.param.valuesAt,
                     "found " + std::to_string(v.count) + " numbers, expected a multiple of " +
                         std::to_string(v.type->perElement),
                     "; those too many are left out, as in PBRT-v3");
    spectral.resize(spectral.size() - std::min(excess, spectral.size()));
  }
  return v.type->kind != ParamKind::Spectrum ||
         spectra_.fromNumbers(v.param, *v.type, spectral, whatOf(v), tolerateIn(v));
}

/// A single infinite number stands for the largest one ("no limit"); among others it has no meaning.
bool ParamParser::settleInfinity(Values& v) {
  if (v.infinite.empty()) return true;
  if (v.count != 1) {
    problem(v, v.infiniteAt, "found " + v.infinite + ", expected finite numbers");
    return false;
  }
  float& value = std::get<std::vector<float>>(v.param.values).front();
  value = std::copysign(std::numeric_limits<float>::max(), value);
  toleratedProblem(v, v.infiniteAt, "found " + v.infinite + ", expected a finite number",
                   std::string("; it is infinite in PBRT-v3, the largest number is taken: ") +
                       (value < 0 ? "-" : "") + "3.4028235e38");
  return true;
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
