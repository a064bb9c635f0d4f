// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

#include "base/diagnostics.h"
#include "scene/param_list.h"

namespace pbrtmedia {

/// The parameters of a text of `"type name" values` entries, as they stand after a directive. `shownName`:
/// what messages call the text. Problems go to `diagnostics`; what has none is returned.
ParamList parseParams(std::string_view text, std::string_view shownName, Diagnostics& diagnostics);

}  // namespace pbrtmedia
