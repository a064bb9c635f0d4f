// SPDX-License-Identifier: BSD-2-Clause
#include "scene/param_type.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/diagnostics.h"
#include "scene/lexer.h"

namespace pbrtmedia {
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

}  // namespace

const ParamType* findParamType(std::string_view keyword) {
  const auto it =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.keyword == keyword; });
  return it == kTypes.end() ? nullptr : &*it;
}

std::string suggestParamType(std::string_view found) {
  if (found == "int") return "; did you mean \"integer\"?";
  std::vector<std::string_view> names;
  for (const ParamType& t : kTypes) names.push_back(t.keyword);
  return suggestion(found, names);
}

std::string_view nextWord(std::string_view text, std::size_t& i) {
  const std::size_t start = std::min(text.find_first_not_of(" \t", i), text.size());
  i = std::min(text.find_first_of(" \t", start), text.size());
  return text.substr(start, i - start);
}

bool looksLikeDeclaration(std::string_view raw) {
  if (raw.size() < 2) return false;
  const std::string_view text = raw.substr(1, raw.size() - 2);
  std::size_t i = 0;
  return findParamType(nextWord(text, i)) && !nextWord(text, i).empty();
}

bool looksLikeNumber(std::string_view raw) {
  return !raw.empty() && raw.find_first_of("0123456789") <= 2 && (raw[0] < 'A' || raw[0] > 'Z');
}

std::string wrongNumber(std::string_view raw, NumberPrefix::Kind kind) {
  const std::string message = "found " + shown(raw);
  switch (kind) {
    case NumberPrefix::Kind::Infinite: {
      const bool isWord = raw.find_first_of("0123456789") == raw.npos;
      return message + (isWord ? ", expected a finite number" : ", which is too large");
    }
    case NumberPrefix::Kind::NotANumber:
      return message + ", expected a finite number";
    default:
      return message + ", expected a number";
  }
}

}  // namespace pbrtmedia
