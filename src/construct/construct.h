// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cameras/camera.h"
#include "construct/construct_options.h"
#include "film/film.h"
#include "render/integrator.h"
#include "samplers/sampler.h"
#include "scene/description.h"
#include "world/scene.h"

namespace pbrtmedia {

/// A scene that is ready to be rendered.
struct Construction {
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Camera> camera;
  std::unique_ptr<Sampler> sampler;
  std::unique_ptr<Integrator> integrator;
  std::unique_ptr<Film> film;
  std::optional<Bounds2i> pixelBounds;
  std::filesystem::path outfile;
  /// For --verbose: what was built, what was left out and what that saved.
  std::vector<std::string> report;
};

/// Turns a description into objects. First everything is read and checked, so that all problems stand in
/// `diagnostics` together; only without errors anything heavy starts, and only what is referred to is built.
/// Takes the large arrays out of `scene`. Nothing when there were errors. Throws nothing for broken input.
std::optional<Construction> construct(SceneDescription& scene, const ConstructOptions& options,
                                      Diagnostics& diagnostics);

}  // namespace pbrtmedia
