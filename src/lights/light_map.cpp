// SPDX-License-Identifier: BSD-2-Clause
#include "lights/light_map.h"

#include <sstream>
#include <stdexcept>

#include "base/interruption.h"
#include "base/parallel.h"

namespace pbrtmedia {
namespace {

const Image& checked(const Image& image) {
  if (image.width() < 1 || image.height() < 1) throw std::invalid_argument("light map: the picture is empty");
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.rgb(x, y);
      if (c.isFinite()) continue;
      std::ostringstream message;
      message << "light map: pixel (" << x << ", " << y << ") is " << c << ", not a finite colour";
      throw std::invalid_argument(message.str());
    }
  }
  return image;
}

}  // namespace

LightMap::LightMap(const Image& image)
    : pyramid_(makeLightMap(checked(image))),
      aspect_(static_cast<float>(image.width()) / static_cast<float>(image.height())) {}

// Interpolation is bilinear between texel centres and repeats, so the mean over a cell is the 3 x 3
// neighbourhood weighted by (1/8, 3/4, 1/8) per axis: the integral of the hat function over the texel and
// over half of each neighbour.
std::vector<float> LightMap::cellMeans(Rgb factor) const {
  const auto columns = static_cast<std::size_t>(width()), rows = static_cast<std::size_t>(height());
  std::vector<float> alongRow(columns * rows), means(columns * rows);
  constexpr float kCentre = 0.75f, kSide = 0.125f;
  parallelFor(rows, [&](std::size_t y) {
    leaveIfStopped();
    std::vector<float> row(columns);
    for (std::size_t x = 0; x < columns; ++x) {
      const Rgb c = factor * texel(static_cast<int>(x), static_cast<int>(y));
      row[x] = (std::abs(c.r) + std::abs(c.g) + std::abs(c.b)) / 3;
    }
    for (std::size_t x = 0; x < columns; ++x) {
      alongRow[y * columns + x] =
          kCentre * row[x] + kSide * (row[(x + columns - 1) % columns] + row[(x + 1) % columns]);
    }
  });
  parallelFor(rows, [&](std::size_t y) {
    const float* here = &alongRow[y * columns];
    const float* above = &alongRow[(y + rows - 1) % rows * columns];
    const float* below = &alongRow[(y + 1) % rows * columns];
    for (std::size_t x = 0; x < columns; ++x) {
      means[y * columns + x] = kCentre * here[x] + kSide * (above[x] + below[x]);
    }
  });
  return means;
}

}  // namespace pbrtmedia
