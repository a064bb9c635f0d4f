// SPDX-License-Identifier: BSD-2-Clause
#include "film/filter_table.h"

#include <numeric>

namespace pbrtmedia {
namespace {

// A sample at offset o in [0, 1) of the pixel k away lies k + o - 1/2 from the centre.
int firstWithin(float radius) { return static_cast<int>(std::floor(-0.5 - radius)) + 1; }
int lastWithin(float r) { return static_cast<int>(std::ceil(0.5 + r)) - 1; }

}  // namespace

FilterTable::FilterTable(const Filter& filter)
    : radius_(filter.radius()),
      cellsX_(kWidth / radius_.x),
      cellsY_(kWidth / radius_.y),
      first_(firstWithin(radius_.x), firstWithin(radius_.y)),
      last_(lastWithin(radius_.x), lastWithin(radius_.y)),
      values_{} {
  for (int y = 0; y < kWidth; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      values_[static_cast<std::size_t>(y * kWidth + x)] =
          filter.evaluate({(static_cast<float>(x) + 0.5f) * radius_.x / kWidth,
                           (static_cast<float>(y) + 0.5f) * radius_.y / kWidth});
    }
  }
}

double FilterTable::integral() const {
  const double sum = std::accumulate(values_.begin(), values_.end(), 0.0);
  return sum * 4 * static_cast<double>(radius_.x) * static_cast<double>(radius_.y) / (kWidth * kWidth);
}

}  // namespace pbrtmedia
