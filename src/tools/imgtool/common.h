// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "image/codecs.h"
#include "image/image.h"
#include "image/storage.h"

// What the commands of imgtool share. Commands print to standard output, return the exit status, and throw
// SceneError or std::runtime_error for files that cannot be read, written or combined.

namespace pbrtmedia {

struct LoadedImage {
  Image image;         ///< linear values
  ImageFormat format;  ///< of the file
  ImageStorage stored;
};

/// Reads an image and linearises R, G, B and Y of formats that store sRGB. Throws SceneError.
LoadedImage loadLinear(const std::filesystem::path& path);

/// The different values that images have under a key, in their order, a line each; those of a merge come
/// apart again. Empty when none has it.
std::string eachOf(const std::vector<const Image*>& images, const std::string& key);

/// Throws std::runtime_error for a name or a place that no image can be written to, before any work is done.
void requireWritable(const std::filesystem::path& path);

/// "(x0, y0) - (x1, y1)", max exclusive.
std::string toString(const Bounds2i& b);

/// Shortest text that reads back as the same float; "nan" and "inf" for what is not finite.
std::string shortest(float v);

}  // namespace pbrtmedia
