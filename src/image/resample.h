// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/bounds.h"
#include "image/image.h"

namespace pbrtmedia {

enum class ResizeFilter {
  Box,     ///< average over the area a new pixel covers: keeps the mean of the image
  Lanczos  ///< windowed sinc with three lobes; sharper, may overshoot and turn negative
};

/// All channels resized separably; both windows become (0, 0) - (width, height), metadata is kept. Weights
/// are normalised to 1 per pixel, and pixels beyond the edge repeat it (Lanczos). Throws
/// std::invalid_argument for a size below 1 or an empty image.
Image resize(const Image& image, int width, int height, ResizeFilter filter);

/// The pixels [min, max) counted from the top left of `image`; the data window says where they lie in the
/// picture. Throws std::invalid_argument when the rectangle is empty or leaves the image.
Image crop(const Image& image, Bounds2i pixels);

/// Every pixel as `count` x `count` pixels; windows are scaled. Throws std::invalid_argument for count < 1.
Image repeatPixels(const Image& image, int count);

/// Top row last; a data window is mirrored inside the display window.
Image flipVertically(const Image& image);

}  // namespace pbrtmedia
