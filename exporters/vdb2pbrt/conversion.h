// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "base/bounds.h"
#include "vdb2pbrt/framed_scene.h"
#include "vdb2pbrt/grid_selection.h"
#include "vdb2pbrt/nvdb_output.h"
#include "vdb2pbrt/vdb_density.h"

namespace pbrtmedia {

enum class DenseForm { None, Inline, Gz };
/// What becomes of grids that tell distances.
enum class LevelSetRule { Error, Fog };

/// One run of vdb2pbrt, but for the frames. What is not given is chosen by the volume (`settled`).
struct ConversionOptions {
  GridWishes grids;
  std::string medium;  ///< name of the medium when there is one density; "": the grid's name
  NegativeRule negative = NegativeRule::Clamp;
  NanRule nan = NanRule::Error;
  LevelSetRule levelSet = LevelSetRule::Error;
  DenseForm dense = DenseForm::None;
  NvdbOptions nvdb;
  std::optional<Vec3d> sigmaA, sigmaS;  ///< per unit of world length at density 1, >= 0
  std::optional<double> scale;
  std::optional<Vec3d> le;  ///< radiance where no temperature gives it
  std::optional<double> leScale, temperatureScale;
  double temperatureOffset = 0;
  std::filesystem::path scene;  ///< "": none
  std::optional<UpAxis> up;
  std::optional<Bounds3d> sceneBox;  ///< what the camera frames: all frames of a sequence
  bool isSettled = false;            ///< nothing is left to choose
};

/// Called with what is being done and its share, or a negative number where that is not known.
using Progress = std::function<void(const std::string&, double)>;

/// Converts one .vdb file: writes `output` (a .pbrt include; with DenseForm::Gz gzip-compressed), unless
/// dense the .nvdb file of the same name beside it, and the scene if one is wanted. Throws std::runtime_error
/// or SceneError; then none of these has been touched, or the first ones alone.
void convertVdb(const std::filesystem::path& input, const std::filesystem::path& output,
                const ConversionOptions& options, const Notice& notice, const Progress& progress = {});

/// The options with everything that this volume decides filled in, but for `sceneBox`: so that all frames of
/// a sequence look alike.
ConversionOptions settled(const std::filesystem::path& input, const ConversionOptions& options,
                          const Notice& notice, const Progress& progress = {});

/// World box of the chosen densities; what the file's metadata tells, without reading trees, where it does.
Bounds3d boxOfDensities(const std::filesystem::path& input, const ConversionOptions& options);

}  // namespace pbrtmedia
