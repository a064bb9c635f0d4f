// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/loose_numbers.h"
#include "scene/param_list.h"
#include "scene/spectrum_values.h"
#include "scene/token_stream.h"

namespace pbrtmedia {

/// Reads parameter lists (reference 3). Spectra become RGB here.
class ParamParser {
 public:
  ParamParser(TokenStream& tokens, Diagnostics& diagnostics, bool readFiles);

  /// All `"type name" values` up to the next token that is no quoted string. A parameter with a problem is
  /// reported and left out. Throws SceneError where reading on needs a new directive.
  ParamList parse(const InputFolders& folders);
  /// Those of parameters, and of whoever reads the same tokens.
  LooseNumbers& looseNumbers() { return loose_; }
  /// What spectra were read from.
  const SpectrumValues& spectra() const { return spectra_; }

 private:
  struct Values;  // what is being read
  void parseOne(const InputFolders& folders, ParamList& list);
  /// Behind the declaration. False: the parameter is left out.
  bool parseValues(const InputFolders& folders, Values& v);
  void checkFirstValue(const Token& first, const Values& v) const;
  bool isOfType(const Token& first, Values& v);
  bool readNumbers(Values& v);
  bool settleInfinity(Values& v);
  template <class T, class Sink>
  bool collect(Values& v, std::vector<T>& block, Sink&& sink);
  template <class T>
  bool appendNumber(Values& v, const Token& token, std::vector<T>& block);
  bool readStrings(Values& v);
  void skipValues(bool bracketed);
  /// How messages about the parameter begin.
  static std::string whatOf(const Values& v);
  void problem(const Values& v, const SourceLocation& at, const std::string& message);
  /// What PBRT-v3 goes on with: `consequence`.
  void toleratedProblem(Values& v, const SourceLocation& at, const std::string& found,
                        std::string_view consequence);
  SpectrumValues::Tolerate tolerateIn(Values& v);
  /// Remembers it for those who take nothing but what is written.
  static void addMisread(Values& v, const SourceLocation& at, const std::string& found);
  /// Throws SceneError when a quote is missing on the line of the token: then nothing else on it makes sense.
  void checkQuotes(const Token& token) const;

  TokenStream& tokens_;
  Diagnostics& diagnostics_;
  SpectrumValues spectra_;
  LooseNumbers loose_;
  std::vector<float> floatBlock_;
  std::vector<int> intBlock_;
};

}  // namespace pbrtmedia
