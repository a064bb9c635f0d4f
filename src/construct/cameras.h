// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "cameras/camera.h"
#include "scene/description.h"

namespace pbrtmedia {

/// Reads Camera and makes it (cameras are small). Null after an error.
std::unique_ptr<Camera> readCamera(SceneDescription& scene, Point2i fullResolution, Diagnostics& diagnostics);

}  // namespace pbrtmedia
