// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/cat.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <vector>

#include "tools/imgtool/common.h"

namespace pbrtmedia {
namespace {

/// NaN sorts above everything, so that it is found at the end.
float sortKey(const Image& image, Point2i p) {
  const float luminance = image.rgb(p.x, p.y).luminance();
  return std::isnan(luminance) ? kInfinity : luminance;
}

}  // namespace

int runCat(const CatOptions& options) {
  const Image image = loadLinear(options.file).image;
  std::vector<Point2i> pixels;
  pixels.reserve(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) pixels.emplace_back(x, y);
  }
  if (options.sort) {
    if (!image.hasRgb()) throw std::runtime_error(options.file + ": --sort needs channels R, G, B or Y");
    std::stable_sort(pixels.begin(), pixels.end(),
                     [&](Point2i a, Point2i b) { return sortKey(image, a) < sortKey(image, b); });
  }
  std::cout << "# x, y:";
  for (const std::string& channel : image.channels()) std::cout << ' ' << channel;
  std::cout << '\n';
  for (const Point2i p : pixels) {
    const Point2i shown = p + image.dataWindow.min;
    std::cout << '(' << shown.x << ", " << shown.y << "):";
    for (std::size_t c = 0; c < image.channelCount(); ++c)
      std::cout << ' ' << shortest(image.at(p.x, p.y, c));
    std::cout << '\n';
  }
  return 0;
}

}  // namespace pbrtmedia
