// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "base/transform.h"
#include "fields/grid_field.h"
#include "fields/nano_vdb_field.h"
#include "media/emission/emission_pattern.h"

namespace pbrtmedia {

/// How values become temperatures: (value - offset) * scale kelvin, as PBRT-v4 has it.
struct TemperatureMap {
  float scale = 1, offset = 0;
};

// Patterns from a grid of numbers: factors >= 0 on the radiance, or temperatures of black bodies whose
// spectrum is scaled to a peak of 1 (spectrum/spectrum.h), in RGB with negative channels cut; at 100 K and
// below they are black, as in PBRT-v4. Outside the grid the number is 0. Values are checked as densities are:
// SceneError.
std::shared_ptr<const EmissionPattern> makeScalePattern(const GridField::Params& grid,
                                                        const Transform& worldFromMedium);
std::shared_ptr<const EmissionPattern> makeScalePattern(const NanoVdbField::Params& grid,
                                                        const Transform& worldFromMedium);
std::shared_ptr<const EmissionPattern> makeBlackbodyPattern(const GridField::Params& grid,
                                                            const TemperatureMap& map,
                                                            const Transform& worldFromMedium);
std::shared_ptr<const EmissionPattern> makeBlackbodyPattern(const NanoVdbField::Params& grid,
                                                            const TemperatureMap& map,
                                                            const Transform& worldFromMedium);
/// One pattern times the other, as black bodies times factors in PBRT-v4. Neither may be null.
std::shared_ptr<const EmissionPattern> makeProductPattern(std::shared_ptr<const EmissionPattern> a,
                                                          std::shared_ptr<const EmissionPattern> b);

}  // namespace pbrtmedia
