// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "world/media_topology.h"

namespace pbrtmedia {

/// A medium that goes on for ever around the scene and lets nothing through from infinitely far: light
/// sources at infinity cannot shine into it. Asks what rays from the camera at `origin` (world) are in when
/// they have passed the last surface; where most of several fixed directions agree that is the answer, else
/// null.
const Medium* findEndlessMedium(const MediaTopology& media, Point3f origin, float time);

}  // namespace pbrtmedia
