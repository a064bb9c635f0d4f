// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <utility>

#include "film/film.h"
#include "filters/box.h"
#include "media/grid_medium.h"
#include "world/scene.h"
#include "world/scene_builder.h"

namespace pbrtmedia::test {

/// A medium of eight super-voxels whose bounds are learned, and nothing else.
inline std::unique_ptr<Scene> checkpointScene() {
  GridMediumParams params;
  params.name = "m";
  params.sigmaA = params.sigmaS = Rgb(1);
  params.grid = {.nx = 2, .ny = 2, .nz = 2, .density = {1, 2, 3, 4, 5, 6, 7, 8}};
  params.bounds.source = BoundsParams::Source::Progressive;
  params.bounds.cells = {{2, 2, 2}};
  SceneBuilder builder;
  builder.addMedium(makeGridMedium(params, Transform()));
  return builder.finish();
}

inline Film checkpointFilm() {
  Film::Settings settings;
  settings.resolution = {3, 2};
  return {settings, BoxFilter({.radius = {.5f, .5f}})};
}

}  // namespace pbrtmedia::test
