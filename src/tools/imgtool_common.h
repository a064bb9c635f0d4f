// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <string>

#include "base/bounds.h"
#include "image/codecs.h"
#include "image/image.h"

// What the commands of imgtool share. Commands print to standard output, return the exit status, and throw
// SceneError or std::runtime_error for files that cannot be read, written or combined.

namespace pbrtmedia {

struct LoadedImage {
  Image image;         ///< linear values
  ImageFormat format;  ///< of the file
};

/// Reads an image and linearises R, G, B and Y of formats that store sRGB. Throws SceneError.
LoadedImage loadLinear(const std::filesystem::path& path);

/// Throws std::runtime_error for a name that no image can be written under, before any work is done.
void requireWritable(const std::filesystem::path& path);

/// "(x0, y0) - (x1, y1)", max exclusive.
std::string toString(const Bounds2i& b);

/// Shortest text that reads back as the same float; "nan" and "inf" for what is not finite.
std::string shortest(float v);

}  // namespace pbrtmedia
