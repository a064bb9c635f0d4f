// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "shapes/surface_interaction.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Changes `si.shading` as if the surface were displaced along its shading normal by `displacement` (world
/// units): Blinn 1978, doi:10.1145/800248.507101, with forward differences of half a pixel step, 0.0005 where
/// the footprint is unknown. Null: no change. A displacement that leaves no normal changes nothing.
void applyBumpMap(const FloatTexture* displacement, SurfaceInteraction& si);

}  // namespace pbrtmedia
