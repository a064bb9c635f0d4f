// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/directives.h"
#include "scene/entity.h"
#include "scene/param_parser.h"
#include "scene/token_stream.h"

namespace pbrtmedia {

/// A directive with its arguments, as written; what they mean is not looked at.
struct Statement {
  struct Text {
    std::string text;
    SourceLocation at;
  };
  const DirectiveInfo* info = nullptr;
  SourceLocation at;  ///< the keyword
  std::string word;
  SourceLocation wordAt;
  std::array<double, 16> numbers{};
  std::vector<Text> strings;
  std::string value;  ///< of Define, as tokens
  ParamList params;
  std::shared_ptr<const InputFolders> folders;

  /// Fills in all of an entity; `which` string is its type. The parameters are moved.
  void moveInto(Entity& entity, std::size_t which = 0);
};

/// Reads statement after statement. On SceneError call `TokenStream::skipToDirective` and go on.
class StatementReader {
 public:
  StatementReader(TokenStream& tokens, ParamParser& params) : tokens_(tokens), params_(params) {}
  /// Nothing at the end of the input.
  std::optional<Statement> next();

 private:
  void readNumbers(Statement& s);
  void readStrings(Statement& s);
  void readValue(Statement& s);

  TokenStream& tokens_;
  ParamParser& params_;
};

}  // namespace pbrtmedia
