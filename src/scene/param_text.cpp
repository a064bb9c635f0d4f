// SPDX-License-Identifier: BSD-2-Clause
#include "scene/param_text.h"

#include <string>
#include <utility>

#include "scene/messages.h"
#include "scene/param_parser.h"
#include "scene/token_stream.h"

namespace pbrtmedia {

ParamList parseParams(std::string_view text, std::string_view shownName, Variables& variables,
                      Diagnostics& diagnostics) {
  diagnostics.keepText(std::string(shownName), std::string(text));
  Diagnostics all;  // PBRT-v3 has no such text, so nothing of it is tolerated
  all.strict = true;
  TokenStream tokens(all, variables);
  const InputFolders folders{".", "."};
  tokens.pushText(text, shownName, folders);
  tokens.expectNoDirectives();
  ParamParser parser(tokens, all, true);
  ParamList list;
  try {
    list = parser.parse(folders);
    const Token& rest = tokens.peek();
    if (rest.kind != Token::Kind::End) {
      all.error(tokens.locate(rest), "found " + shown(rest.raw) + ", expected \"type name\" and values");
    }
  } catch (const SceneError& e) {
    all.add(e);
  }
  parser.looseNumbers().report();
  variables = tokens.variables();
  for (Diagnostic d : all.all()) {
    constexpr std::string_view kSuffix = " [--strict]";  // has no part in it
    if (d.message.ends_with(kSuffix)) d.message.erase(d.message.size() - kSuffix.size());
    diagnostics.add(d.severity, d.location, std::move(d.message));
  }
  return list;
}

}  // namespace pbrtmedia
