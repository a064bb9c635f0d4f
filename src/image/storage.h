// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "image/codecs.h"

namespace pbrtmedia {

/// How a file stores pixels, in words of the command line where it has one.
struct ImageStorage {
  /// OpenEXR: half, float or uint, "R half, Z float" where channels differ. PNG, TGA: "8 bits" a channel, "24
  /// bits" a pixel. PFM: float.
  std::string pixelType;
  std::string compression;  ///< none, zip, piz, ...; PNG: deflate
};

/// Of the bytes of a file that decodeImage accepts.
ImageStorage storageOf(ImageFormat format, std::span<const std::byte> bytes, const std::string& name);

}  // namespace pbrtmedia
