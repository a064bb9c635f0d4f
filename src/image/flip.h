// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "image/image.h"

namespace pbrtmedia {

/// Pixels per degree of a 0.7 m wide monitor of 3840 pixels seen from 0.7 m: the paper's default.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

/// The LDR-ꟻLIP error map: one channel "Y" in [0, 1], 0 where the images look alike. Values are taken as
/// linear Rec. 709 and clamped to [0, 1], as a display would. Both images need a colour, one size and finite
/// values (std::invalid_argument). Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström & Fairchild 2020,
/// "FLIP: A Difference Evaluator for Alternating Images", doi:10.1145/3406183. Symmetric in its arguments.
Image flipMap(const Image& reference, const Image& test, double pixelsPerDegree = kFlipPixelsPerDegree);

/// Mean of the map.
double flipMean(const Image& map);

}  // namespace pbrtmedia
