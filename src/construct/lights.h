// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "lights/diffuse_area.h"
#include "lights/light.h"
#include "scene/description.h"

namespace pbrtmedia {

/// A light whose parameters are checked; reads its map, and may throw SceneError for a map that is unusable.
/// A map that cannot be read is told of, and the light shines without.
using LightPlan = std::function<std::unique_ptr<Light>()>;

/// Reads a LightSource. Nothing for one that is left out: of an unknown type, without direction, in a space
/// that is flat. `quick` divides "samples" by four. `diagnostics` must outlive the plan.
std::optional<LightPlan> readLight(LightDescription& light, bool quick, Diagnostics& diagnostics);
/// Reads an AreaLightSource.
std::optional<DiffuseAreaLight::Params> readAreaLight(Entity& light, bool quick, Diagnostics& diagnostics);

}  // namespace pbrtmedia
