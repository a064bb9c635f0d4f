// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

#include "base/transform.h"
#include "base/vec.h"

namespace pbrtmedia {

/// World from the unit cube of the box with opposite corners p0, p1 in medium space; the corners may come in
/// any order (the data is then mirrored). Throws SceneError (location unknown) when the box is flat, not
/// finite, or the transform has no inverse. `field` names the field in the message.
Transform worldFromUnitCube(Point3f p0, Point3f p1, const Transform& worldFromMedium, std::string_view field);

}  // namespace pbrtmedia
