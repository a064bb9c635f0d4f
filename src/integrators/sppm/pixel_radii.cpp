// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/sppm/pixel_radii.h"

#include <cmath>
#include <cstdint>

namespace pbrtmedia {
namespace {

void shrinkBy(double& size, double& photons, std::uint64_t found) {
  if (found == 0) return;
  const auto m = static_cast<double>(found);
  const double kept = photons + PixelRadii::kGamma * m;
  size *= kept / (photons + m);
  photons = kept;
}

}  // namespace

void PixelRadii::start(double radius) {
  for (std::size_t i = 0; i < numbers_.size(); i += kNumbers) {
    numbers_[i] = radius * radius;
    numbers_[i + 2] = radius * radius * radius;
    numbers_[i + 1] = numbers_[i + 3] = 0;
  }
}

PixelRadii::Radii PixelRadii::of(std::size_t pixel) const {
  const std::size_t i = pixel * kNumbers;
  return {static_cast<float>(std::sqrt(numbers_[i])), static_cast<float>(std::cbrt(numbers_[i + 2]))};
}

void PixelRadii::shrink(std::size_t pixel, const PhotonGather::Found& found) {
  const std::size_t i = pixel * kNumbers;
  shrinkBy(numbers_[i], numbers_[i + 1], found.onSurfaces);
  shrinkBy(numbers_[i + 2], numbers_[i + 3], found.inMedia);
}

}  // namespace pbrtmedia
