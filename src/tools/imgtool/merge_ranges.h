// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <vector>

#include "tools/imgtool/merge.h"

namespace pbrtmedia {

/// Whether an image is a range of the samples of a render (`pbrt --samples`).
bool isRange(const NamedImage& input);

/// Ranges of the samples of one render, put together: their sums are added in order of the ranges, in double.
/// With all samples that is the image of one render, bit for bit but for rounding of these sums, which a
/// float hardly ever shows; else a larger range. "sampleRange" lists what it holds. Throws std::runtime_error
/// naming the files for: what mergeRenders refuses, another seed or number of samples, ranges that overlap,
/// and images that have lost their sums.
Image mergeRanges(std::vector<NamedImage> inputs);

}  // namespace pbrtmedia
