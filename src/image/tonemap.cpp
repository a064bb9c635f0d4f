// SPDX-License-Identifier: BSD-2-Clause
#include "image/tonemap.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "image/channels.h"

namespace pbrtmedia {
namespace {

template <class F>
void mapColors(Image& image, F&& f) {
  requireColor(image);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) image.setRgb(x, y, f(image.rgb(x, y)));
  }
}

Rgb medianByLuminance(const Image& image, int x, int y) {
  std::vector<Rgb> near;
  for (int j = std::max(0, y - 1); j <= std::min(image.height() - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(image.width() - 1, x + 1); ++i) {
      near.push_back(image.rgb(i, j));
    }
  }
  std::stable_sort(near.begin(), near.end(), [](Rgb a, Rgb b) { return a.luminance() < b.luminance(); });
  return near[near.size() / 2];
}

/// Symmetric weights for distances 0, 1, ..., radius.
std::vector<float> gaussian(int width) {
  const float sigma = std::max(0.25f * static_cast<float>(width), 0.25f);
  std::vector<float> weights;
  for (int i = 0; i <= width / 2; ++i) {
    const float d = static_cast<float>(i) / sigma;
    weights.push_back(std::exp(-0.5f * d * d));
  }
  return weights;
}

/// A line of `count` colours, `stride` apart, blurred; weights that fall outside are left out.
void blurLine(const Rgb* from, Rgb* to, int count, std::size_t stride, const std::vector<float>& weights) {
  const int radius = static_cast<int>(weights.size()) - 1;
  for (int i = 0; i < count; ++i) {
    Rgb sum;
    float total = 0;
    for (int j = std::max(0, i - radius); j <= std::min(count - 1, i + radius); ++j) {
      const float w = weights[static_cast<std::size_t>(std::abs(i - j))];
      sum += w * from[static_cast<std::size_t>(j) * stride];
      total += w;
    }
    to[static_cast<std::size_t>(i) * stride] = sum / total;
  }
}

void blur(std::vector<Rgb>& pixels, int width, int height, const std::vector<float>& weights) {
  std::vector<Rgb> rows(pixels.size());
  const std::size_t w = static_cast<std::size_t>(width);
  for (int y = 0; y < height; ++y) {
    const std::size_t start = static_cast<std::size_t>(y) * w;
    blurLine(&pixels[start], &rows[start], width, 1, weights);
  }
  for (std::size_t x = 0; x < w; ++x) blurLine(&rows[x], &pixels[x], height, w, weights);
}

}  // namespace

void scaleColors(Image& image, float factor) {
  mapColors(image, [&](Rgb c) { return factor * c; });
}

void offsetColors(Image& image, float offset) {
  mapColors(image, [&](Rgb c) { return c + Rgb(offset); });
}

void toneMap(Image& image, float maxLuminance) {
  if (!(maxLuminance > 0)) throw std::invalid_argument("the luminance that becomes 1 must be above 0");
  const float inverseSquare = 1 / (maxLuminance * maxLuminance);
  mapColors(image, [&](Rgb c) {
    const float y = c.luminance();
    return ((1 + y * inverseSquare) / (1 + y)) * c;
  });
}

void preserveColors(Image& image) {
  mapColors(image, [](Rgb c) { return c.max() > 1 ? c / c.max() : c; });
}

void despike(Image& image, float threshold) {
  requireColor(image);
  const Image original = image;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (original.rgb(x, y).luminance() >= threshold) image.setRgb(x, y, medianByLuminance(original, x, y));
    }
  }
}

void bloom(Image& image, const BloomParams& params) {
  requireColor(image);
  if (params.width < 1 || params.width % 2 == 0) {
    throw std::invalid_argument("the width of a bloom must be odd, found " + std::to_string(params.width));
  }
  if (params.iterations < 1) throw std::invalid_argument("a bloom needs at least one iteration");
  std::vector<Rgb> glow;
  glow.reserve(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.rgb(x, y);
      glow.push_back(c.luminance() >= params.level ? c : Rgb(0));
    }
  }
  std::vector<Rgb> sum(glow.size());
  const std::vector<float> weights = gaussian(params.width);
  for (int i = 0; i < params.iterations; ++i) {
    blur(glow, image.width(), image.height(), weights);
    for (std::size_t p = 0; p < sum.size(); ++p) sum[p] += glow[p];
  }
  const float weight = params.scale / static_cast<float>(params.iterations);
  std::size_t p = 0;
  mapColors(image, [&](Rgb c) { return c + weight * sum[p++]; });
}

}  // namespace pbrtmedia
