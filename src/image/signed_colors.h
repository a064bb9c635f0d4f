// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "image/image.h"

namespace pbrtmedia {

/// What 0 looks like in an image of signed values.
enum class ZeroColor { White, Black };

/// The absolute luminance that all but one in 200 pixels are below or at: a scale for `signedColors` that few
/// bright pixels do not decide. What is not finite does not count; 1 where all is 0. Throws
/// std::invalid_argument for an image without colour.
float usualSize(const Image& image);

/// An image of signed luminances for people: red at `full` > 0 and above, blue at -full and below, in even
/// steps of sRGB between these and 0; green where a value is not finite. Channels R, G, B alone, linear;
/// windows and metadata stay. Throws as usualSize.
Image signedColors(const Image& image, float full, ZeroColor zero);

}  // namespace pbrtmedia
