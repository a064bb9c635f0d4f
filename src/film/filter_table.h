// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/vec.h"
#include "filters/filter.h"

namespace pbrtmedia {

/// A filter as PBRT-v3 looks it up (scene-language reference 8.1): 16 x 16 values over the positive quadrant,
/// which decide the weights.
class FilterTable {
 public:
  explicit FilterTable(const Filter& filter);

  Vector2f radius() const { return radius_; }
  /// Weight of a sample at a distance per axis (sample minus pixel centre); null outside [-radius, radius).
  const float* find(float dx, float dy) const {
    const int y = cell(dy, radius_.y, cellsY_);
    if (y < 0) return nullptr;
    const int x = cell(dx, radius_.x, cellsX_);
    return x < 0 ? nullptr : &values_[static_cast<std::size_t>(y * kWidth + x)];
  }
  /// Over the plane, pixels².
  double integral() const;
  /// Pixels whose samples can reach a pixel, relative to it: from first to last.
  Point2i firstNeighbour() const { return first_; }
  Point2i lastNeighbour() const { return last_; }

 private:
  static constexpr int kWidth = 16;
  static int cell(float d, float radius, float cellsPerPixel) {
    if (!(d >= -radius && d < radius)) return -1;
    return std::min(static_cast<int>(std::abs(d) * cellsPerPixel), kWidth - 1);
  }

  Vector2f radius_;
  float cellsX_, cellsY_;
  Point2i first_, last_;
  std::array<float, static_cast<std::size_t>(kWidth* kWidth)> values_;
};

}  // namespace pbrtmedia
