// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "cameras/camera.h"
#include "scene/description.h"

namespace pbrtmedia {

/// What cameras know of the film.
struct FilmSize {
  Point2i fullResolution;  ///< of the whole film, whatever the crop
  float diagonal = 35;     ///< millimetres
};

/// Reads Camera and makes it (cameras are small). Null after an error.
std::unique_ptr<Camera> readCamera(SceneDescription& scene, const FilmSize& film, Diagnostics& diagnostics);

}  // namespace pbrtmedia
