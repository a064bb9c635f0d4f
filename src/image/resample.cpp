// SPDX-License-Identifier: BSD-2-Clause
#include "image/resample.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

namespace pbrtmedia {
namespace {

/// What one new pixel takes from the old ones along an axis; weights sum to 1.
struct Taps {
  int first = 0;
  std::vector<double> weights;
};

void normalize(Taps& taps) {
  double sum = 0;
  for (const double w : taps.weights) sum += w;
  for (double& w : taps.weights) w /= sum;
}

/// Weight of old pixel i: the length of [i, i+1] inside the stretch that the new pixel covers.
Taps boxTaps(int target, int from, int to) {
  const double scale = static_cast<double>(from) / to;
  const double low = target * scale, high = (target + 1) * scale;
  Taps taps;
  taps.first = std::min(static_cast<int>(low), from - 1);
  for (int i = taps.first; i < from && i < high; ++i) {
    taps.weights.push_back(std::max(0.0, std::min(high, i + 1.0) - std::max(low, static_cast<double>(i))));
  }
  normalize(taps);
  return taps;
}

double lanczos3(double x) {
  constexpr double kLobes = 3;
  if (x == 0) return 1;
  if (std::abs(x) >= kLobes) return 0;
  const double p = std::numbers::pi * x;
  return kLobes * std::sin(p) * std::sin(p / kLobes) / (p * p);
}

/// Lanczos with three lobes, widened when shrinking; taps beyond the edge are added to the edge pixel.
Taps lanczosTaps(int target, int from, int to) {
  const double scale = static_cast<double>(from) / to, widening = std::max(1.0, scale);
  const double centre = (target + 0.5) * scale, radius = 3 * widening;
  const int low = static_cast<int>(std::floor(centre - radius)),
            high = static_cast<int>(std::ceil(centre + radius));
  Taps taps;
  taps.first = std::clamp(low, 0, from - 1);
  taps.weights.assign(static_cast<std::size_t>(std::clamp(high, 0, from - 1) - taps.first + 1), 0.0);
  for (int i = low; i <= high; ++i) {
    const int inside = std::clamp(i, 0, from - 1);
    taps.weights[static_cast<std::size_t>(inside - taps.first)] += lanczos3((i + 0.5 - centre) / widening);
  }
  normalize(taps);
  return taps;
}

std::vector<Taps> makeTaps(int from, int to, ResizeFilter filter) {
  std::vector<Taps> taps;
  taps.reserve(static_cast<std::size_t>(to));
  for (int i = 0; i < to; ++i) {
    taps.push_back(filter == ResizeFilter::Box ? boxTaps(i, from, to) : lanczosTaps(i, from, to));
  }
  return taps;
}

/// An image of another size with the same channels and metadata.
Image emptyLike(const Image& image, int width, int height) {
  Image out(width, height, image.channels());
  out.metadata = image.metadata;
  return out;
}

Image resizeRows(const Image& image, int width, ResizeFilter filter) {
  const std::vector<Taps> taps = makeTaps(image.width(), width, filter);
  Image out = emptyLike(image, width, image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < width; ++x) {
      const Taps& t = taps[static_cast<std::size_t>(x)];
      for (std::size_t c = 0; c < image.channelCount(); ++c) {
        double sum = 0;
        for (std::size_t i = 0; i < t.weights.size(); ++i) {
          sum += t.weights[i] * static_cast<double>(image.at(t.first + static_cast<int>(i), y, c));
        }
        out.at(x, y, c) = static_cast<float>(sum);
      }
    }
  }
  return out;
}

Image resizeColumns(const Image& image, int height, ResizeFilter filter) {
  const std::vector<Taps> taps = makeTaps(image.height(), height, filter);
  Image out = emptyLike(image, image.width(), height);
  for (int y = 0; y < height; ++y) {
    const Taps& t = taps[static_cast<std::size_t>(y)];
    for (int x = 0; x < image.width(); ++x) {
      for (std::size_t c = 0; c < image.channelCount(); ++c) {
        double sum = 0;
        for (std::size_t i = 0; i < t.weights.size(); ++i) {
          sum += t.weights[i] * static_cast<double>(image.at(x, t.first + static_cast<int>(i), c));
        }
        out.at(x, y, c) = static_cast<float>(sum);
      }
    }
  }
  return out;
}

/// Pixels of `out` taken from `image` at source(x, y).
void copyPixels(Image& out, const Image& image, const std::function<Point2i(int, int)>& source) {
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      const Point2i from = source(x, y);
      for (std::size_t c = 0; c < out.channelCount(); ++c) out.at(x, y, c) = image.at(from.x, from.y, c);
    }
  }
}

Bounds2i scaled(const Bounds2i& b, int n) { return {b.min * n, b.max * n}; }

}  // namespace

Image resize(const Image& image, int width, int height, ResizeFilter filter) {
  if (width < 1 || height < 1) throw std::invalid_argument("an image needs at least one pixel per side");
  if (image.data().empty()) throw std::invalid_argument("an image without pixels cannot be resized");
  return resizeColumns(resizeRows(image, width, filter), height, filter);
}

Image crop(const Image& image, Bounds2i pixels) {
  if (pixels.area() == 0 || pixels.min.x < 0 || pixels.min.y < 0 || pixels.max.x > image.width() ||
      pixels.max.y > image.height()) {
    throw std::invalid_argument("the crop is empty or leaves the image");
  }
  Image out = emptyLike(image, pixels.width(), pixels.height());
  copyPixels(out, image, [&](int x, int y) { return Point2i{x + pixels.min.x, y + pixels.min.y}; });
  out.dataWindow = {image.dataWindow.min + pixels.min, image.dataWindow.min + pixels.max};
  out.displayWindow = image.displayWindow;
  return out;
}

Image repeatPixels(const Image& image, int count) {
  if (count < 1) throw std::invalid_argument("pixels can be repeated once or more often");
  const std::int64_t width = std::int64_t{image.width()} * count,
                     height = std::int64_t{image.height()} * count;
  constexpr std::int64_t kLargestSide = std::int64_t{1} << 20;
  if (width > kLargestSide || height > kLargestSide) {
    throw std::invalid_argument("the repeated image would have a side above 1048576 pixels");
  }
  Image out = emptyLike(image, static_cast<int>(width), static_cast<int>(height));
  copyPixels(out, image, [&](int x, int y) { return Point2i{x / count, y / count}; });
  out.dataWindow = scaled(image.dataWindow, count);
  out.displayWindow = scaled(image.displayWindow, count);
  return out;
}

Image flipVertically(const Image& image) {
  Image out = emptyLike(image, image.width(), image.height());
  copyPixels(out, image, [&](int x, int y) { return Point2i{x, image.height() - 1 - y}; });
  const int sum = image.displayWindow.min.y + image.displayWindow.max.y;
  out.dataWindow = {{image.dataWindow.min.x, sum - image.dataWindow.max.y},
                    {image.dataWindow.max.x, sum - image.dataWindow.min.y}};
  out.displayWindow = image.displayWindow;
  return out;
}

}  // namespace pbrtmedia
