// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "world/coincident_surfaces.h"
#include "world/media_walk.h"
#include "world/subsurface_probe.h"

namespace pbrtmedia {

/// Where a path goes below a surface.
struct SubsurfaceEntry {
  const SceneHit& hit;
  const SurfaceInteraction& si;
  const CoincidentSurfaces& coincident;
};

/// What media are outside of the surface where the path leaves it again: those of a straight way between the
/// two. `state`: on arrival at the entry; afterwards that on departure.
void passMediaBelow(const MediaWalk::Context& context, MediumState& state, const SubsurfaceEntry& entry,
                    const SubsurfaceEmergence& exit, float time);

}  // namespace pbrtmedia
