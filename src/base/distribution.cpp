// SPDX-License-Identifier: BSD-2-Clause
#include "base/distribution.h"

#include <algorithm>
#include <cmath>

#include "base/built_parts.h"
#include "base/math.h"

namespace pbrtmedia {

Distribution1D::Distribution1D(std::span<const float> weights) : weights_(weights.begin(), weights.end()) {
  const std::size_t n = weights_.size();
  double sum = 0;
  for (const float w : weights_) sum += w;
  integral_ = n > 0 ? sum / static_cast<double>(n) : 0;
  if (!(sum > 0)) {
    std::fill(weights_.begin(), weights_.end(), 1.0f);
    sum = static_cast<double>(n);
  }
  cdf_.resize(n + 1);
  double running = 0;
  for (std::size_t i = 0; i < n; ++i) {
    cdf_[i] = running / sum;
    running += weights_[i];
  }
  if (n > 0) {
    // Everything from the last positive weight on is 1, so that u next to 1 cannot reach a weight of 0.
    std::size_t last = n;
    while (last > 0 && weights_[last - 1] == 0) --last;
    std::fill(cdf_.begin() + static_cast<std::ptrdiff_t>(last), cdf_.end(), 1.0);
  }
}

Distribution1D::Choice Distribution1D::choose(float u) const {
  const auto above = std::upper_bound(cdf_.begin(), cdf_.end(), static_cast<double>(u));
  const std::size_t index =
      std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - cdf_.begin() - 1, 0)), size() - 1);
  const double width = cdf_[index + 1] - cdf_[index];
  const double inside = width > 0 ? (u - cdf_[index]) / width : 0;
  return {index, static_cast<float>(width), std::min(static_cast<float>(inside), kOneMinusEpsilon)};
}

Distribution1D::Sample Distribution1D::sample(float u) const {
  const Choice c = choose(u);
  const float n = static_cast<float>(size());
  float x = std::min((static_cast<float>(c.index) + c.remapped) / n, kOneMinusEpsilon);
  // Rounding must not carry x into a neighbour, which may have another density: `pdf(x)` is this one's.
  while (x > 0 && static_cast<std::size_t>(x * n) > c.index) x = std::nextafter(x, 0.0f);
  while (static_cast<std::size_t>(x * n) < c.index) x = std::nextafter(x, 1.0f);
  return {x, c.probability * n, c.index};
}

float Distribution1D::pdf(float x) const {
  const auto index = static_cast<std::size_t>(std::max(0.0f, x) * static_cast<float>(size()));
  return probability(std::min(index, size() - 1)) * static_cast<float>(size());
}

float Distribution1D::probability(std::size_t index) const {
  return static_cast<float>(cdf_[index + 1] - cdf_[index]);
}

Distribution2D::Distribution2D(std::span<const float> weights, std::size_t width, std::size_t height) {
  countBuilt(Part::LightDistributions);
  rows_.reserve(height);
  std::vector<float> sums(height);
  for (std::size_t y = 0; y < height; ++y) {
    rows_.emplace_back(weights.subspan(y * width, width));
    sums[y] = static_cast<float>(rows_.back().integral());
  }
  marginal_ = Distribution1D(sums);
}

Distribution2D::Sample Distribution2D::sample(Point2f u) const {
  const Distribution1D::Sample y = marginal_.sample(u.y);
  const Distribution1D::Sample x = rows_[y.index].sample(u.x);
  return {{x.x, y.x}, x.pdf * y.pdf};
}

float Distribution2D::pdf(Point2f p) const {
  const float n = static_cast<float>(rows_.size());
  const auto row = std::min(static_cast<std::size_t>(std::max(0.0f, p.y) * n), rows_.size() - 1);
  return rows_[row].pdf(p.x) * marginal_.probability(row) * n;
}

}  // namespace pbrtmedia
