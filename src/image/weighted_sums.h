// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "image/image.h"

namespace pbrtmedia {

/// What a pixel is divided from: weighted sums of samples.
struct WeightedSums {
  double r = 0, g = 0, b = 0, weight = 0;
  WeightedSums& operator+=(const WeightedSums& o) {
    r += o.r;
    g += o.g;
    b += o.b;
    weight += o.weight;
    return *this;
  }
  bool operator==(const WeightedSums&) const = default;
};

/// How sums become the value of a pixel.
struct Development {
  float scale = 1;
  bool keepsNegatives = false;  ///< else they are 0
  /// Of a weighted mean; the largest float where it is beyond.
  float value(double mean) const;
  Rgb colour(const WeightedSums& sums) const;
};

/// Adds channels "sums.r.0" ... "sums.weight.2" that hold the sums of all pixels (row by row) exactly: a
/// double is the sum of three floats where it is below 2^127 and above 2^-90, else nearly. And the
/// development, as metadata "filmScale" and "keepsNegatives"; "sumsHash" tells when channels were changed.
/// `others`: as many more sums for each pixel as there are, in channels "sums.0.0", ...
Image withSums(const Image& image, std::span<const WeightedSums> sums, const Development& development,
               std::span<const double> others = {});
struct PixelSums {
  std::vector<WeightedSums> colours;
  std::vector<double> others;
};
/// The sums in an image; nothing when it has no such channels, or they are no longer what they were.
std::optional<PixelSums> sumsOf(const Image& image);
/// The development in an image with sums. Throws std::invalid_argument for metadata that is none.
Development developmentOf(const Image& image);
/// The image without these channels.
Image withoutSums(const Image& image);

}  // namespace pbrtmedia
