// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "image/image.h"

// Operations on the colours of a linear image. Other channels stay. All throw std::invalid_argument for an
// image without colour or a parameter out of range.

namespace pbrtmedia {

/// Multiplies colours by `factor`.
void scaleColors(Image& image, float factor);

/// Adds `offset` to each channel of them.
void offsetColors(Image& image, float offset);

/// Reinhard's global operator: colours times (1 + Y/Ymax^2) / (1 + Y), Y the luminance. `maxLuminance` > 0 is
/// the luminance that becomes 1.
void toneMap(Image& image, float maxLuminance);

/// Divides a colour by its largest channel where that exceeds 1, so that clipping keeps the hue.
void preserveColors(Image& image);

/// Replaces a pixel whose luminance is at least `threshold` by the one with the median luminance among its
/// 3x3 neighbourhood (the upper median at borders, where the count may be even). Reads the unfiltered image.
void despike(Image& image, float threshold);

struct BloomParams {
  float level = 0;     ///< pixels at or above this luminance glow
  int width = 15;      ///< pixels of the blur, odd
  float scale = 0.3f;  ///< weight of the glow
  int iterations = 5;  ///< blurs of the blur, >= 1
};

/// Adds scale times the mean of `iterations` successive Gaussian blurs of the bright pixels. The kernel has
/// standard deviation width/4 and is renormalised at borders.
void bloom(Image& image, const BloomParams& params);

}  // namespace pbrtmedia
