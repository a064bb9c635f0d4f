// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

#include "base/diagnostics.h"
#include "scene/param_list.h"
#include "scene/variables.h"

namespace pbrtmedia {

/// The parameters of a text of `"type name" values` entries, as they stand after a directive. `shownName`:
/// what messages call the text. Variables stand for their values, and those in the text then count as used.
/// Problems go to `diagnostics`; what has none is returned.
ParamList parseParams(std::string_view text, std::string_view shownName, Variables& variables,
                      Diagnostics& diagnostics);

}  // namespace pbrtmedia
