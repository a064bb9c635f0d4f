// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "image/image.h"

namespace pbrtmedia {

/// An estimate of the root of the mean squared error of `after`, over pixels and colour channels, from how
/// far it is from `before`: means of n' and n > n' samples of a pixel, the first among the second. Their
/// difference has the variance v (1/n' - 1/n) where one sample has v, and `after` has v/n. The estimate of
/// the square is unbiased for independent samples; for the better distributed ones of other samplers it is as
/// good as the image improves like them. It knows nothing of errors that both have. Nothing when the images
/// are not of a kind, have no colours, or n <= n'.
std::optional<double> errorFromChange(const Image& before, double samplesBefore, const Image& after,
                                      double samples);

}  // namespace pbrtmedia
