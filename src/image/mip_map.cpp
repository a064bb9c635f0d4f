// SPDX-License-Identifier: BSD-2-Clause
#include "image/mip_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "base/interruption.h"
#include "base/math.h"

namespace pbrtmedia {

namespace {

std::size_t at(int width, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

/// Index in [0, n), or -1 for "black".
int wrapIndex(int i, int n, WrapMode wrap) {
  if (i >= 0 && i < n) return i;
  switch (wrap) {
    case WrapMode::Repeat:
      i %= n;
      return i < 0 ? i + n : i;
    case WrapMode::Clamp:
      return i < 0 ? 0 : n - 1;
    case WrapMode::Black:
      break;
  }
  return -1;
}

/// Largest integer <= x, far-away and NaN coordinates brought into the range of int.
int floorToInt(float x) {
  constexpr float kFar = 0x1p30f;
  if (std::isnan(x)) return 0;
  return static_cast<int>(std::floor(std::clamp(x, -kFar, kFar)));
}

float lanczos2(float distance) {
  const float x = std::abs(distance);
  if (x < 1e-5f) return 1;
  if (x >= 2) return 0;
  const float a = kPi * x, b = 0.5f * a;
  return std::sin(a) / a * (std::sin(b) / b);
}

/// Four source texels and their normalised weights for one resampled texel.
struct ResampleTap {
  int first;
  std::array<float, 4> weights;
};

std::vector<ResampleTap> resampleTaps(int from, int to) {
  std::vector<ResampleTap> taps(static_cast<std::size_t>(to));
  for (int i = 0; i < to; ++i) {
    const float centre = (static_cast<float>(i) + 0.5f) * static_cast<float>(from) / static_cast<float>(to);
    ResampleTap& tap = taps[static_cast<std::size_t>(i)];
    tap.first = static_cast<int>(std::floor(centre - 1.5f));
    float sum = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      const float position = static_cast<float>(tap.first) + static_cast<float>(j) + 0.5f;
      sum += tap.weights[j] = lanczos2(position - centre);
    }
    for (float& w : tap.weights) w /= sum;
  }
  return taps;
}

/// Resamples one line. `source(i)` and `target(i)` name texels; the sum runs over differences to a near
/// texel, so that constants stay exactly what they are.
template <class T, class Source>
T resampled(const ResampleTap& tap, int n, WrapMode wrap, const Source& source) {
  const auto value = [&](int i) {
    const int wrapped = wrapIndex(i, n, wrap);
    return wrapped < 0 ? T(0.0f) : T(source(wrapped));
  };
  const T near = value(std::clamp(tap.first + 1, 0, n - 1));
  T sum = near;
  for (int j = 0; j < 4; ++j) {
    sum += tap.weights[static_cast<std::size_t>(j)] * (value(tap.first + j) - near);
  }
  return sum;
}

float clampAtZero(float v) { return std::max(v, 0.0f); }
Rgb clampAtZero(Rgb v) { return v.nonNegative(); }

template <class T>
std::vector<T> resampleToPowersOfTwo(const std::vector<T>& in, int& width, int& height, WrapMode wrap) {
  const int newWidth = static_cast<int>(std::bit_ceil(static_cast<unsigned>(width)));
  const int newHeight = static_cast<int>(std::bit_ceil(static_cast<unsigned>(height)));
  std::vector<T> wide(static_cast<std::size_t>(newWidth) * static_cast<std::size_t>(height));
  const std::vector<ResampleTap> tapsX = resampleTaps(width, newWidth),
                                 tapsY = resampleTaps(height, newHeight);
  for (int y = 0; y < height; ++y) {
    leaveIfStopped();
    for (int x = 0; x < newWidth; ++x) {
      wide[at(newWidth, x, y)] = width == newWidth
                                     ? in[at(width, x, y)]
                                     : resampled<T>(tapsX[static_cast<std::size_t>(x)], width, wrap,
                                                    [&](int i) { return in[at(width, i, y)]; });
    }
  }
  std::vector<T> out(static_cast<std::size_t>(newWidth) * static_cast<std::size_t>(newHeight));
  for (int y = 0; y < newHeight; ++y) {
    leaveIfStopped();
    for (int x = 0; x < newWidth; ++x) {
      const T v = height == newHeight ? wide[at(newWidth, x, y)]
                                      : resampled<T>(tapsY[static_cast<std::size_t>(y)], height, wrap,
                                                     [&](int i) { return wide[at(newWidth, x, i)]; });
      out[at(newWidth, x, y)] = clampAtZero(v);
    }
  }
  width = newWidth;
  height = newHeight;
  return out;
}

bool isPowerOfTwo(int n) { return std::has_single_bit(static_cast<unsigned>(n)); }

float lengthOf(Vector2f v) { return std::hypot(v.x, v.y); }

}  // namespace

template <class T>
MipMap<T>::MipMap(int width, int height, std::vector<T> texels, WrapMode wrap) : wrap_(wrap) {
  // A power of two above this does not fit an int.
  constexpr int kLargestSide = 1 << 30;
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide ||
      texels.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    throw std::invalid_argument("image pyramid: " + std::to_string(texels.size()) + " texels for " +
                                std::to_string(width) + " x " + std::to_string(height));
  }
  if (!isPowerOfTwo(width) || !isPowerOfTwo(height)) {
    texels = resampleToPowersOfTwo(texels, width, height, wrap);
  }
  levels_.push_back({width, height, std::move(texels)});
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& fine = levels_.back();
    Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
    coarse.texels.reserve(at(coarse.width, 0, coarse.height));
    for (int y = 0; y < coarse.height; ++y) {
      leaveIfStopped();
      for (int x = 0; x < coarse.width; ++x) {
        // A side of one texel is its own neighbour. Pairs first: exact for constants.
        const int x0 = fine.width > 1 ? 2 * x : 0, x1 = fine.width > 1 ? 2 * x + 1 : 0;
        const int y0 = fine.height > 1 ? 2 * y : 0, y1 = fine.height > 1 ? 2 * y + 1 : 0;
        const T upper = fine.texels[at(fine.width, x0, y0)] + fine.texels[at(fine.width, x1, y0)];
        const T lower = fine.texels[at(fine.width, x0, y1)] + fine.texels[at(fine.width, x1, y1)];
        coarse.texels.push_back(0.25f * (upper + lower));
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

template <class T>
T MipMap<T>::texel(int level, int x, int y) const {
  const Level& l = levels_[static_cast<std::size_t>(level)];
  const int i = wrapIndex(x, l.width, wrap_), j = wrapIndex(y, l.height, wrap_);
  return i < 0 || j < 0 ? T(0.0f) : l.texels[at(l.width, i, j)];
}

template <class T>
Point2f MipMap<T>::texelPosition(const Level& level, Point2f st) const {
  // One period only: far coordinates keep what digits they have left.
  if (wrap_ == WrapMode::Repeat) st = {st.x - std::floor(st.x), st.y - std::floor(st.y)};
  return {st.x * static_cast<float>(level.width) - 0.5f, st.y * static_cast<float>(level.height) - 0.5f};
}

template <class T>
T MipMap<T>::bilinear(Point2f st, int level) const {
  const Level& l = levels_[static_cast<std::size_t>(level)];
  const Point2f p = texelPosition(l, st);
  if (!isFinite(p)) return texel(level, 0, 0);
  const int x = floorToInt(p.x), y = floorToInt(p.y);
  const float dx = std::clamp(p.x - static_cast<float>(x), 0.0f, 1.0f);
  const float dy = std::clamp(p.y - static_cast<float>(y), 0.0f, 1.0f);
  return (1 - dx) * (1 - dy) * texel(level, x, y) + dx * (1 - dy) * texel(level, x + 1, y) +
         (1 - dx) * dy * texel(level, x, y + 1) + dx * dy * texel(level, x + 1, y + 1);
}

template <class T>
T MipMap<T>::trilinear(Point2f st, float width) const {
  if (!(width > 0)) return bilinear(st);
  const int last = levelCount() - 1;
  const float level = static_cast<float>(last) + std::log2(width);
  if (level <= 0) return bilinear(st);
  if (level >= static_cast<float>(last)) return coarsest();
  const float whole = std::floor(level), share = level - whole;
  const int fine = static_cast<int>(whole);
  return (1 - share) * bilinear(st, fine) + share * bilinear(st, fine + 1);
}

template <class T>
T MipMap<T>::ewa(Point2f st, Vector2f axis0, Vector2f axis1, float maxAnisotropy) const {
  float major = lengthOf(axis0), minor = lengthOf(axis1);
  if (major < minor) {
    std::swap(axis0, axis1);
    std::swap(major, minor);
  }
  if (!(minor > 0) || !isFinite(st)) return bilinear(st);
  if (minor * maxAnisotropy < major) {
    const float widen = major / (minor * maxAnisotropy);
    axis1 = widen * axis1;
    minor *= widen;
  }
  const int last = levelCount() - 1;
  const float level = std::max(0.0f, static_cast<float>(last) + std::log2(minor));
  if (!(level < static_cast<float>(last))) return coarsest();
  const float whole = std::floor(level), share = level - whole;
  const int fine = static_cast<int>(whole);
  const T here = ewaLevel(fine, st, axis0, axis1);
  if (share == 0) return here;
  return (1 - share) * here + share * ewaLevel(fine + 1, st, axis0, axis1);
}

template <class T>
T MipMap<T>::ewaLevel(int level, Point2f st, Vector2f axis0, Vector2f axis1) const {
  const Level& l = levels_[static_cast<std::size_t>(level)];
  const Point2f centre = texelPosition(l, st);
  const float w = static_cast<float>(l.width), h = static_cast<float>(l.height);
  const Vector2f a0{axis0.x * w, axis0.y * h}, a1{axis1.x * w, axis1.y * h};
  // Heckbert 1989, section 3.5.8: the ellipse a x² + b x y + c y² = f, widened by one texel so that a small
  // one still meets texels; it reaches sqrt(c) along x and sqrt(a) along y.
  const float a = sqr(a0.y) + sqr(a1.y) + 1, c = sqr(a0.x) + sqr(a1.x) + 1;
  const float b = -2 * (a0.x * a0.y + a1.x * a1.y);
  const float f = a * c - 0.25f * b * b;
  const float reachX = std::sqrt(c), reachY = std::sqrt(a);
  const int xFirst = floorToInt(std::ceil(centre.x - reachX)), xLast = floorToInt(centre.x + reachX);
  const int yFirst = floorToInt(std::ceil(centre.y - reachY)), yLast = floorToInt(centre.y + reachY);
  constexpr float kEdgeWeight = 0.135335283f;  // e^-2: the Gaussian ends at 0
  T sum(0.0f);
  float weights = 0;
  for (int y = yFirst; y <= yLast; ++y) {
    const float dy = static_cast<float>(y) - centre.y;
    for (int x = xFirst; x <= xLast; ++x) {
      const float dx = static_cast<float>(x) - centre.x;
      const float r2 = (a * dx * dx + b * dx * dy + c * dy * dy) / f;
      if (!(r2 < 1)) continue;
      const float weight = std::exp(-2 * r2) - kEdgeWeight;
      sum += weight * texel(level, x, y);
      weights += weight;
    }
  }
  return weights > 0 ? sum / weights : bilinear(st, level);
}

MipMap<Rgb> makeLightMap(const Image& image, WrapMode wrap) {
  std::vector<Rgb> texels;
  texels.reserve(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) texels.push_back(image.rgb(x, y));
  }
  return {image.width(), image.height(), std::move(texels), wrap};
}

template class MipMap<float>;
template class MipMap<Rgb>;

}  // namespace pbrtmedia
