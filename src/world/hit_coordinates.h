// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "world/scene.h"

namespace pbrtmedia {

/// The largest coordinate that the surface at a hit is computed from, world space: what its rounding is of.
double coordinatesOf(const SceneHit& hit, float time);

}  // namespace pbrtmedia
