// SPDX-License-Identifier: BSD-2-Clause
#include "scene/param_parser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "scene/directives.h"
#include "scene/number.h"
#include "spectrum/spectrum.h"

namespace pbrtmedia {

struct ParamType {
  enum class Spectral { No, Rgb, Xyz, BlackBody, Samples };
  std::string_view keyword;
  ParamKind kind;
  std::uint32_t perElement = 1;
  bool words = false;  ///< values are quoted strings
  Spectral spectral = Spectral::No;
};

namespace {

using Spectral = ParamType::Spectral;
constexpr std::array kTypes{ParamType{"blackbody", ParamKind::Spectrum, 2, false, Spectral::BlackBody},
                            ParamType{"bool", ParamKind::Bool, 1, true},
                            ParamType{"color", ParamKind::Spectrum, 3, false, Spectral::Rgb},
                            ParamType{"float", ParamKind::Float},
                            ParamType{"integer", ParamKind::Integer},
                            ParamType{"normal", ParamKind::Normal, 3},
                            ParamType{"point", ParamKind::Point3, 3},
                            ParamType{"point2", ParamKind::Point2, 2},
                            ParamType{"point3", ParamKind::Point3, 3},
                            ParamType{"rgb", ParamKind::Spectrum, 3, false, Spectral::Rgb},
                            ParamType{"spectrum", ParamKind::Spectrum, 2, false, Spectral::Samples},
                            ParamType{"string", ParamKind::String, 1, true},
                            ParamType{"texture", ParamKind::Texture, 1, true},
                            ParamType{"vector", ParamKind::Vector3, 3},
                            ParamType{"vector2", ParamKind::Vector2, 2},
                            ParamType{"vector3", ParamKind::Vector3, 3},
                            ParamType{"xyz", ParamKind::Spectrum, 3, false, Spectral::Xyz}};

constexpr std::size_t kBlock = 6144;      // numbers converted at once; a multiple of every element size
constexpr std::size_t kMaxParams = 4096;  // per directive: real ones take some twenty

const ParamType* findType(std::string_view keyword) {
  const auto it =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.keyword == keyword; });
  return it == kTypes.end() ? nullptr : &*it;
}

std::string suggestType(std::string_view found) {
  if (found == "int") return "; did you mean \"integer\"?";
  std::vector<std::string_view> names;
  for (const ParamType& t : kTypes) names.push_back(t.keyword);
  return suggestion(found, names);
}

/// The first word of `text` from `i` on, and `i` behind it.
std::string_view word(std::string_view text, std::size_t& i) {
  const std::size_t start = std::min(text.find_first_not_of(" \t", i), text.size());
  i = std::min(text.find_first_of(" \t", start), text.size());
  return text.substr(start, i - start);
}

/// Whether a quoted token in the wrong place looks like the start of the next parameter.
bool looksLikeDeclaration(std::string_view raw) {
  if (raw.size() < 2) return false;
  const std::string_view text = raw.substr(1, raw.size() - 2);
  std::size_t i = 0;
  return findType(word(text, i)) && !word(text, i).empty();
}

bool looksLikeNumber(std::string_view raw) {
  return !raw.empty() && raw.find_first_of("0123456789") <= 2 && (raw[0] < 'A' || raw[0] > 'Z');
}

std::string wrongNumber(std::string_view raw, NumberStatus status) {
  std::string message = "found " + shown(raw);
  if (status == NumberStatus::TooLarge) return message + ", which is too large";
  std::string lower(raw.substr(0, 10));
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  const std::size_t sign = !lower.empty() && (lower[0] == '-' || lower[0] == '+') ? 1 : 0;
  const auto starts = [&](std::string_view s) { return std::string_view(lower).substr(sign, s.size()) == s; };
  if (starts("inf") || starts("nan")) return message + ", expected a finite number";
  if (starts("0x")) return message + ", expected a decimal number";
  if (raw.find('#') != raw.npos) return message + ", expected a number; a comment needs a blank before its #";
  if (raw.find(',') != raw.npos) return message + ", expected numbers separated by blanks";
  return message + ", expected a number";
}

bool convert(const Token& token, float& value, std::string& why) {
  const NumberStatus status = parseFloat(token.raw, value);
  if (status != NumberStatus::Ok) why = wrongNumber(token.raw, status);
  return status == NumberStatus::Ok;
}

}  // namespace

struct ParamParser::Values {
  const ParamType* type = nullptr;
  std::string declaration;  ///< "float fov"
  Param param;
  bool bracketed = false;
  std::size_t count = 0;  ///< tokens read
};

ParamParser::ParamParser(TokenStream& tokens, Diagnostics& diagnostics, bool readFiles)
    : tokens_(tokens), diagnostics_(diagnostics), readFiles_(readFiles) {
  floatBlock_.reserve(kBlock);
  intBlock_.reserve(kBlock);
}

void ParamParser::problem(const Values& v, const SourceLocation& at, const std::string& message) {
  diagnostics_.error(at, "parameter " + inQuotes(v.declaration) + ": " + message);
}

void ParamParser::lenientProblem(const Values& v, const SourceLocation& at, const std::string& message) {
  diagnostics_.lenientError(at, "parameter " + inQuotes(v.declaration) + ": " + message);
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
  if (declaration.kind == Token::Kind::Unclosed) {
    throw SceneError(v.param.declaredAt, "the string has no closing \" on its line");
  }
  const std::string text = unescaped(declaration.raw, v.param.declaredAt);
  std::size_t i = 0;
  const std::string typeName(word(text, i));
  v.param.name = word(text, i);
  const std::string extra(word(text, i));
  v.type = findType(typeName);
  v.declaration = shown(text);
  if (v.param.name.empty()) {
    diagnostics_.error(v.param.declaredAt, "found " + inQuotes(v.declaration) +
                                               ", expected a parameter \"type name\", such as \"float fov\"");
    v.type = nullptr;
  } else if (!v.type) {
    diagnostics_.error(v.param.declaredAt, "parameter " + inQuotes(v.declaration) + ": unknown type \"" +
                                               shown(typeName) + '"' + suggestType(typeName));
  } else if (!extra.empty()) {
    lenientProblem(v, v.param.declaredAt,
                   "found " + inQuotes(shown(extra)) + " after the name, which PBRT-v3 ignores");
  }

  if (tokens_.peek().kind == Token::Kind::Open) {
    v.param.valuesAt = tokens_.locate(tokens_.take());
    v.bracketed = true;
  }
  if (!v.type) return skipValues(v.bracketed);
  v.param.kind = v.type->kind;
  v.param.tokensPerElement = v.type->perElement;

  const Token& first = tokens_.peek();
  const SourceLocation firstAt = tokens_.locate(first);
  const std::string what = "parameter " + inQuotes(v.declaration) + ": ";
  const bool strings = first.kind == Token::Kind::String;
  if (first.kind == Token::Kind::Unclosed)
    throw SceneError(firstAt, "the string has no closing \" on its line");
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
  if (!isEmpty && strings != v.type->words && !(strings && v.type->spectral == Spectral::Samples)) {
    if (v.type->kind == ParamKind::Bool) {
      problem(v, firstAt, "found " + shown(first.raw) + ", expected \"true\" or \"false\" with quotes");
    } else {
      problem(v, firstAt,
              "found " + shown(first.raw) + ", expected " + (v.type->words ? "a quoted string" : "a number"));
    }
    return skipValues(v.bracketed);
  }
  bool good;
  if (strings || (isEmpty && v.type->words)) {
    good = readStrings(v) && (v.type->words || spectrumFiles(v, folders));
  } else {
    good = readNumbers(v);
  }
  if (v.param.marks.size() == 1) v.param.marks = {};
  if (!v.bracketed && tokens_.peek().kind == Token::Kind::Word && looksLikeNumber(tokens_.peek().raw)) {
    throw SceneError(tokens_.locate(tokens_.peek()), what + "several values need brackets: [ … ]");
  }
  if (!good) return;
  if (list.find(v.param.kind, v.param.name)) {
    diagnostics_.warning(v.param.declaredAt, what + "given before in this directive; the last one counts");
  }
  list.add(std::move(v.param));
}

template <class T>
bool ParamParser::appendNumber(Values& v, const Token& token, std::vector<T>& block) {
  std::string why;
  if constexpr (std::is_same_v<T, float>) {
    float value;
    if (convert(token, value, why)) {
      block.push_back(value);
      return true;
    }
  } else {
    double value;
    const NumberStatus status = parseDouble(token.raw, value);
    const bool fits = status == NumberStatus::Ok && value > -2147483649.0 && value < 2147483648.0;
    if (fits) {
      if (value != std::trunc(value)) {
        lenientProblem(
            v, tokens_.locate(token),
            "found " + shown(token.raw) + ", expected a whole number; PBRT-v3 cuts the fraction off");
      }
      block.push_back(static_cast<T>(value));
      return true;
    }
    why = wrongNumber(token.raw, status == NumberStatus::Ok ? NumberStatus::TooLarge : status);
  }
  problem(v, tokens_.locate(token), why);
  return false;
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
  if (!good) return false;
  if (const std::size_t excess = v.count % v.type->perElement; excess != 0) {
    lenientProblem(v, v.param.valuesAt,
                   "found " + std::to_string(v.count) + " numbers, expected a multiple of " +
                       std::to_string(v.type->perElement));
    spectral.resize(spectral.size() - std::min(excess, spectral.size()));
  }
  return v.type->kind != ParamKind::Spectrum || finishSpectrum(v, spectral);
}

bool ParamParser::finishSpectrum(Values& v, const std::vector<float>& n) {
  auto& colours = v.param.values.emplace<std::vector<Rgb>>();
  const std::size_t per = v.type->perElement;
  std::size_t i = 0;
  try {
    if (v.type->spectral == Spectral::Samples) {
      std::vector<SpectralSample> samples;
      for (; i + 1 < n.size(); i += 2) samples.push_back({n[i], n[i + 1]});
      i = 0;
      v.param.tokensPerElement = static_cast<std::uint32_t>(
          std::clamp<std::size_t>(n.size(), 1, std::numeric_limits<std::uint32_t>::max()));
      if (!samples.empty()) colours.push_back(sampledSpectrumToRgb(std::move(samples)));
    } else {
      for (; i + per <= n.size(); i += per) {
        switch (v.type->spectral) {
          case Spectral::BlackBody:
            colours.push_back(blackbodyToRgb(n[i], n[i + 1]));
            break;
          case Spectral::Xyz:
            colours.push_back(xyzToRgb({n[i], n[i + 1], n[i + 2]}));
            break;
          default:
            colours.emplace_back(n[i], n[i + 1], n[i + 2]);
            break;
        }
      }
    }
  } catch (const std::invalid_argument& e) {
    problem(v, v.param.locationOf(i / per), e.what());
    return false;
  }
  for (std::size_t k = 0; k < colours.size(); ++k) {
    if (colours[k].isFinite()) continue;
    problem(v, v.param.locationOf(k), "the spectrum has no finite RGB value");
    return false;
  }
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
    if (next.kind == Token::Kind::Unclosed) throw SceneError(at, "the string has no closing \" on its line");
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
    problem(v, v.param.valuesAt, "found " + std::to_string(strings.size()) + " names, expected one");
    return false;
  }
  if (v.type->kind != ParamKind::Bool) {
    v.param.values = std::move(strings);
    return true;
  }
  auto& bools = v.param.values.emplace<std::vector<std::uint8_t>>();
  for (const std::string& s : strings) {
    if (s != "true" && s != "false") {
      lenientProblem(
          v, v.param.locationOf(bools.size()),
          "found " + inQuotes(shown(s)) + R"(, expected "true" or "false"; PBRT-v3 takes it as false)");
    }
    bools.push_back(s == "true" ? 1 : 0);
  }
  return true;
}

/// Turns the file names read into colours.
bool ParamParser::spectrumFiles(Values& v, const InputFolders& folders) {
  const auto names = std::get<std::vector<std::string>>(std::move(v.param.values));
  auto& colours = v.param.values.emplace<std::vector<Rgb>>();
  v.param.tokensPerElement = 1;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!readFiles_) {
      colours.emplace_back();
      continue;
    }
    const SourceLocation at = v.param.locationOf(i);
    const auto found = folders.locate(names[i]);
    if (!found) {
      problem(v, at, "there is no file \"" + shown(folders.underBase(names[i]).string()) + '"');
      return false;
    }
    if (found->besideIncluder) {
      diagnostics_.warning(at, "using \"" + found->path.string() + "\"; PBRT-v3 looks for \"" +
                                   folders.underBase(names[i]).string() + '"');
    }
    const auto [cached, isNew] = spectra_.try_emplace(found->path);
    try {
      if (isNew) cached->second = sampledSpectrumToRgb(readSpectrumFile(found->path));
    } catch (const SceneError& e) {
      diagnostics_.add(e);
      diagnostics_.note(at, "the file is named here");
    } catch (const std::invalid_argument& e) {
      problem(v, at, '"' + found->path.string() + "\": " + e.what());
    }
    if (!cached->second) return false;
    colours.push_back(*cached->second);
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
