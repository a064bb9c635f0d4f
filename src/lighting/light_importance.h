// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/vec.h"
#include "lighting/light_receiver.h"
#include "lighting/light_tree.h"

namespace pbrtmedia {

/// Estimates of the light that arrives from the lights of one node, which steer the choice among nodes. None
/// is ever 0: what bounds and cones say is dark keeps a small part, since they are estimates themselves
/// (a shading normal may turn a surface, a sheared transformation the cone of a spot light).
///
/// At a point: intensity / r², as W/m² on a surface that faces the light, times the cosine there, or in a
/// medium 4π times its phase function, the latter two where the receiver tells.
double importanceAt(const LightReceiver& at, const LightTree::Node& node);

/// The same factors for light of one direction: 1 where nothing dims it, a small part at least. `toLight`:
/// unit.
double receptionFrom(const LightReceiver& at, Vector3f toLight);

/// Along the line o + t d from tMin to tMax (which may be infinite): the integral of intensity / r² over it.
double importanceAlong(Vec3d o, Vec3d d, double tMin, double tMax, const LightTree::Node& node);

}  // namespace pbrtmedia
