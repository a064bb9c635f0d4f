// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <string>

#include "base/diagnostics.h"
#include "scene/input_folders.h"
#include "scene/param_list.h"

namespace pbrtmedia {

/// A plugin as the scene asks for it: type name and parameters, not yet checked against what exists.
struct Entity {
  std::string type;             ///< "" where the directive is absent (or says "")
  SourceLocation location;      ///< the directive's keyword; no file where the directive is absent
  SourceLocation typeLocation;  ///< the quoted type
  ParamList params;             ///< MakeNamedX: the `string type` that gave `type` is in it, marked used
  std::shared_ptr<const InputFolders> folders;  ///< for file names in `params`; null where absent
  bool given = false;                           ///< false: the directive is absent, PBRT-v3's default holds
};

}  // namespace pbrtmedia
