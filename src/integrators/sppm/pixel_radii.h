// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <span>

#include "integrators/sppm/photon_gather.h"

namespace pbrtmedia {

/// The radii of all pixels. After an iteration in which a pixel found M photons besides N before, the area of
/// its disc, or the volume of its ball, shrinks by (N + gamma M) / (N + M), and gamma of these M count from
/// then on, gamma = 2/3, as in PBRT-v3. Borrows plain numbers, so that renders can go on from them.
class PixelRadii {
 public:
  static constexpr std::size_t kNumbers = 4;  ///< of a pixel
  static constexpr double kGamma = 2.0 / 3;

  explicit PixelRadii(std::span<double> numbers) : numbers_(numbers) {}
  /// All pixels before the first iteration.
  void start(double radius);
  struct Radii {
    float onSurfaces = 0, inMedia = 0;
  };
  Radii of(std::size_t pixel) const;
  /// Pixels in which nothing was found stay as they are.
  void shrink(std::size_t pixel, const PhotonGather::Found& found);

 private:
  std::span<double> numbers_;  ///< area / pi and photons; volume / (4 pi / 3) and photons
};

}  // namespace pbrtmedia
