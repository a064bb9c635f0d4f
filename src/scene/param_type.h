// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "scene/number.h"
#include "scene/param_list.h"

namespace pbrtmedia {

/// What a type keyword of parameter lists means (reference 3).
struct ParamType {
  enum class Spectral { No, Rgb, Xyz, BlackBody, Samples };
  std::string_view keyword;
  ParamKind kind;
  std::uint32_t perElement = 1;
  bool words = false;  ///< values are quoted strings
  Spectral spectral = Spectral::No;
};

/// Null when there is no such keyword.
const ParamType* findParamType(std::string_view keyword);
/// "; did you mean …" for a keyword that is none.
std::string suggestParamType(std::string_view found);

/// The first word of `text` from `i` on, and `i` behind it.
std::string_view nextWord(std::string_view text, std::size_t& i);
/// Whether a quoted token in the wrong place looks like the start of the next parameter.
bool looksLikeDeclaration(std::string_view raw);
bool looksLikeNumber(std::string_view raw);
/// What is wrong with a word where a finite number is expected, and what was found.
std::string wrongNumber(std::string_view raw, NumberPrefix::Kind kind);

}  // namespace pbrtmedia
