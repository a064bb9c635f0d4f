// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "image/image.h"
#include "support/running_stats.h"

namespace pbrtmedia::test {

/// How far a reference and the mean of independent renders are apart, pixel by pixel.
struct PixelDistance {
  double squared = 0;   ///< sum over pixels and channels
  double variance = 0;  ///< what of it noise and the storage of the reference as half explain
};
/// `noises`: variances of one render that the two have together, 1/n for the mean of n alone.
inline PixelDistance pixelDistance(std::span<const Image> renders, const Image& reference, double noises) {
  PixelDistance distance;
  for (int y = 0; y < reference.height(); ++y) {
    for (int x = 0; x < reference.width(); ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        RunningStats ours;
        for (const Image& image : renders) ours.add(image.at(x, y, c));
        const double r = reference.at(x, y, c);
        const double halfSpacing = std::max(std::abs(r), 6e-5) * 0x1p-11;
        distance.squared += (r - ours.mean()) * (r - ours.mean());
        distance.variance += ours.variance() * noises + halfSpacing * halfSpacing;
      }
    }
  }
  return distance;
}

}  // namespace pbrtmedia::test
