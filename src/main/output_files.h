// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "image/image.h"
#include "main/options.h"
#include "scene/description.h"

namespace pbrtmedia {

/// Finds out before hours of rendering that a file named by an option could not be written in the end: throws
/// SceneError with the option, the file and the reason.
void requireWritable(const std::string& option, const std::filesystem::path& file);

/// The image file of a world as Film or its default names it.
std::string imageNameOf(const SceneDescription& world);

/// Worlds whose images would have one name, so that only the last one stays, are reported where the later one
/// names its file: tolerated, as PBRT-v3 renders both.
void reportSharedOutputs(const std::vector<SceneDescription>& worlds, const Options& options,
                         Diagnostics& diagnostics);

/// The same of the images that `bdpt` makes of its strategies, whose names are always the same.
void reportSharedStrategyImages(const std::vector<SceneDescription>& worlds, const Options& options,
                                Diagnostics& diagnostics);
/// Whether a world has such images.
bool makesStrategyImages(const SceneDescription& world);

/// Files that the run would write over what it reads (scenes and their includes, and what parameters name:
/// volumes, meshes, images, ...) or has written itself: errors, as nobody wants that. `mediumParams`: those
/// of
/// --mediumparams.
void reportLostFiles(const std::vector<SceneDescription>& worlds, const ParamList& mediumParams,
                     const Options& options, Diagnostics& diagnostics);

/// What came of writing an image.
struct SavedImage {
  std::filesystem::path file;  ///< where it is
  std::string problem;         ///< why it is not where it was wanted; "": it is
};

/// Writes an image; when that fails, under a name of its own in the working folder or else in the folder for
/// temporary files, so that a render is not lost. Throws std::runtime_error with the first reason when
/// nothing can be written anywhere.
SavedImage saveImage(const std::filesystem::path& wanted, const Image& image, const WriteOptions& write);

}  // namespace pbrtmedia
