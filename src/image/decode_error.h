// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <string>

#include "base/diagnostics.h"

namespace pbrtmedia {

/// Throws SceneError about a file as a whole.
[[noreturn]] inline void failFile(const std::string& name, const std::string& message) {
  throw SceneError(SourceLocation{std::make_shared<const std::string>(name)}, message);
}

}  // namespace pbrtmedia
