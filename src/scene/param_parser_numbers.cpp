// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "scene/directives.h"
#include "scene/number.h"
#include "scene/param_parser.h"
#include "scene/param_parser_values.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kBlock = 6144;  // numbers converted at once; a multiple of every element size

}  // namespace

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
  block.reserve(kBlock);
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

}  // namespace pbrtmedia
