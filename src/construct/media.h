// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "media/medium.h"
#include "scene/description.h"

namespace pbrtmedia {

/// A medium whose parameters are checked; `make` builds the grid and its bounds. Call it once: it takes the
/// density out of the description. May throw SceneError.
using MediumPlan = std::function<std::unique_ptr<Medium>()>;

/// Reads a MakeNamedMedium. Nothing for an unknown type or after an error.
std::optional<MediumPlan> readMedium(MediumDescription& medium, Diagnostics& diagnostics);

}  // namespace pbrtmedia
