// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

#include "shapes/surface_interaction.h"
#include "world/coincident_surfaces.h"
#include "world/scene.h"

namespace pbrtmedia {

/// What a path comes upon next.
enum class PathEvent : std::uint8_t { End, Surface, Medium };

/// Where a path meets a surface that scatters.
struct SurfaceVertex {
  SceneHit hit;
  SurfaceInteraction si;
  CoincidentSurfaces coincident;
};

}  // namespace pbrtmedia
