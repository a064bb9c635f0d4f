// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

namespace pbrtmedia {

class Image;

/// Sums, in double, over what light paths bring to a pixel from anywhere; they have no weights.
struct SplatSum {
  double r = 0, g = 0, b = 0;
  SplatSum& operator+=(const SplatSum& o) {
    r += o.r;
    g += o.g;
    b += o.b;
    return *this;
  }
  bool operator==(const SplatSum&) const = default;
};

/// The light paths behind such sums.
struct SplatPaths {
  std::uint64_t count = 0;  ///< a whole number, as sums of it depend on no grouping
  double area = 0;          ///< pixels over which they spread
  bool operator==(const SplatPaths&) const = default;

  /// What a sum adds to a pixel's radiance: the mean over paths, each of which stands for `area` pixels.
  SplatSum mean(const SplatSum& sum) const;
  /// The variance of that mean, estimated without bias for independent paths. `squares`: sums of the squares
  /// of what each path brings. Nothing is known of fewer than two paths: 0.
  SplatSum varianceOfMean(const SplatSum& sum, const SplatSum& squares) const;
};

/// As metadata "splatPaths" and "splatArea" of an image that keeps sums of splats, and back. Throws
/// std::invalid_argument for metadata that is none.
void putSplatPaths(const SplatPaths& paths, Image& image);
bool hasSplatPaths(const Image& image);
SplatPaths splatPathsOf(const Image& image);

}  // namespace pbrtmedia
