// SPDX-License-Identifier: BSD-2-Clause
#include "lights/light_map.h"

#include <sstream>
#include <stdexcept>

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

}  // namespace pbrtmedia
