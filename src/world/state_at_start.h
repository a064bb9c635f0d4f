// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "world/media_topology.h"

namespace pbrtmedia {

/// What a ray starts in that starts on a surface of which it leaves out `start`, or anywhere else: told
/// halfway to what it meets first, which is off that surface.
MediumState stateAtStart(const MediaTopology& media, const Ray& ray, const Exclusions& start,
                         RenderCounters& counters);

}  // namespace pbrtmedia
