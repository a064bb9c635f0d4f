// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "scene/param_parser.h"

namespace pbrtmedia {

/// One parameter while ParamParser reads it.
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

}  // namespace pbrtmedia
