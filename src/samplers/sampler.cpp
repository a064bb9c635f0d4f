// SPDX-License-Identifier: BSD-2-Clause
#include "samplers/sampler.h"

#include <cmath>

namespace pbrtmedia {
namespace {

/// pixel + u, kept below pixel + 1 where float rounding would carry it into the next pixel.
float filmCoordinate(int pixel, float u) {
  const float corner = static_cast<float>(pixel), position = corner + u;
  return position < corner + 1 ? position : std::nextafter(corner + 1, corner);
}

}  // namespace

CameraSample Sampler::cameraSample(Point2i pixel) {
  Point2f film = get2D();  // taken even when pinned: the dimensions after it stay the same
  if (pinsPixelCentre_) film = {0.5f, 0.5f};
  const float time = get1D();
  return {{filmCoordinate(pixel.x, film.x), filmCoordinate(pixel.y, film.y)}, get2D(), time};
}

}  // namespace pbrtmedia
