// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "lights/diffuse_area.h"
#include "lights/light.h"
#include "scene/description.h"

namespace pbrtmedia {

/// A light whose parameters are checked; `make` reads its map and may throw SceneError.
using LightPlan = std::function<std::unique_ptr<Light>()>;

/// Reads a LightSource. Nothing for an unknown type or after an error. `quick` divides "samples" by four.
std::optional<LightPlan> readLight(LightDescription& light, bool quick, Diagnostics& diagnostics);
/// Reads an AreaLightSource.
std::optional<DiffuseAreaLight::Params> readAreaLight(Entity& light, bool quick, Diagnostics& diagnostics);

}  // namespace pbrtmedia
