// SPDX-License-Identifier: BSD-2-Clause
#include "scene/param_text.h"

#include <string>

#include "scene/messages.h"
#include "scene/param_parser.h"
#include "scene/token_stream.h"

namespace pbrtmedia {

ParamList parseParams(std::string_view text, std::string_view shownName, Diagnostics& diagnostics) {
  diagnostics.keepText(std::string(shownName), std::string(text));
  TokenStream tokens;
  const InputFolders folders{".", "."};
  tokens.pushText(text, shownName, folders);
  ParamParser parser(tokens, diagnostics, true);
  ParamList list;
  try {
    list = parser.parse(folders);
    const Token& rest = tokens.peek();
    if (rest.kind != Token::Kind::End) {
      diagnostics.error(tokens.locate(rest),
                        "found " + shown(rest.raw) + ", expected \"type name\" and values");
    }
  } catch (const SceneError& e) {
    diagnostics.add(e);
  }
  return list;
}

}  // namespace pbrtmedia
