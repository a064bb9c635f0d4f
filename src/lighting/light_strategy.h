// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "base/bounds.h"
#include "lighting/light_selector.h"
#include "lights/illuminant.h"

namespace pbrtmedia {

/// "lightsamplestrategy" (scene-language reference 11.3). The choice affects noise only: every strategy gives
/// every light a positive probability everywhere.
enum class LightStrategy {
  Uniform,  ///< all lights equal
  Power,    ///< proportional to the luminance of Illuminant::power(), at least a thousandth of the average
  Spatial,  ///< by what arrives at the point, tabulated over a grid (see SpatialLightSelector)
  Tree,     ///< by what may arrive at the point and be scattered there (see LightTreeSelector)
  Learned,  ///< the same, times what exploratory paths have found
};

/// "uniform", "power", "spatial", "tree", "learned"; nothing for any other word.
std::optional<LightStrategy> lightStrategyOfName(std::string_view name);

/// `lights`: the scene's table, at least one, already preprocessed; borrowed for the life of the selector.
/// One light: nothing to choose, whatever was asked. No surfaces (empty `sceneBounds`), so no grid: power.
std::unique_ptr<const LightSelector> makeLightSelector(LightStrategy strategy,
                                                       std::span<const Illuminant* const> lights,
                                                       const Bounds3f& sceneBounds);

}  // namespace pbrtmedia
