// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "construct/construct_options.h"
#include "construct/layers.h"
#include "film/film.h"
#include "scene/description.h"

namespace pbrtmedia {

/// Film and filter as asked for.
struct FilmPlan {
  Film::Settings settings;
  float diagonal = 35;            ///< millimetres; for cameras that know the size of their film
  std::filesystem::path outfile;  ///< relative to the working directory, as in PBRT-v3
  std::unique_ptr<Filter> filter;
  LayerRequest layers;  ///< for chooseLayers
};

/// Reads Film and PixelFilter. Problems go to `diagnostics`; the plan is then incomplete (filter may be
/// null). The output's format and folder are checked here, before anything is rendered.
FilmPlan readFilm(SceneDescription& scene, const ConstructOptions& options, Diagnostics& diagnostics);

}  // namespace pbrtmedia
