// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "image/image.h"
#include "support/running_stats.h"

namespace pbrtmedia::test {

/// Sum over pixels and channels.
inline double squaredDistance(const Image& a, const Image& b) {
  double sum = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const Rgb d = a.rgb(x, y) - b.rgb(x, y);
      sum += double{d.r} * double{d.r} + double{d.g} * double{d.g} + double{d.b} * double{d.b};
    }
  }
  return sum;
}

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

/// Pixels this many times brighter than the mean (lights in view) are not dim; the reference alone decides.
inline constexpr double kBright = 4;

/// The mean of independent renders of one scene against a reference, relative to its mean.
struct MeanDistance {
  double difference = 0, standardError = 0;  ///< over all pixels; the error is that of the renders alone
  double dimDifference = 0, dimError = 0;    ///< over the dim ones, whose noise does not hide everything
};
inline MeanDistance meanDistance(std::span<const Image> renders, const Image& reference) {
  const auto sumOf = [&](const Image& image, double limit) {
    double sum = 0;
    for (int y = 0; y < reference.height(); ++y) {
      for (int x = 0; x < reference.width(); ++x) {
        if (static_cast<double>(reference.rgb(x, y).max()) <= limit)
          sum += static_cast<double>(image.rgb(x, y).average());
      }
    }
    return sum;
  };
  const double infinity = std::numeric_limits<double>::infinity(), whole = sumOf(reference, infinity);
  const double limit = kBright * whole / (1.0 * reference.width() * reference.height());
  RunningStats all, dim;
  for (const Image& image : renders) {
    all.add(sumOf(image, infinity));
    dim.add(sumOf(image, limit));
  }
  const double dimWhole = sumOf(reference, limit);
  return {all.mean() / whole - 1, all.standardError() / whole, dim.mean() / dimWhole - 1,
          dim.standardError() / dimWhole};
}

}  // namespace pbrtmedia::test
