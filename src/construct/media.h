// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "media/medium.h"
#include "scene/description.h"

namespace pbrtmedia {

class Textures;

/// A medium whose parameters are checked; `make` builds the grid and its bounds. Call it once: it takes the
/// density out of the description. Takes the textures it refers to, which must live as long as the medium.
/// May throw SceneError.
using MediumPlan = std::function<std::unique_ptr<Medium>(Textures&)>;

/// Reads a MakeNamedMedium. Nothing after an error, and for what PBRT-v3 takes as vacuum: an unknown type, a
/// density that does not fit. `isUsed`: false leaves files closed. `building` takes what is found while the
/// plan is carried out, and must outlive it.
std::optional<MediumPlan> readMedium(MediumDescription& medium, bool isUsed, Diagnostics& diagnostics,
                                     Diagnostics& building);

}  // namespace pbrtmedia
