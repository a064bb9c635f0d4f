// SPDX-License-Identifier: BSD-2-Clause
#include "lights/sphere_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math.h"

namespace pbrtmedia {

Point2f latLong(Vector3f w) {
  const float u = std::atan2(w.y, w.x) * kInv2Pi;
  return {std::min(u < 0 ? u + 1 : u, kOneMinusEpsilon), std::atan2(std::hypot(w.x, w.y), w.z) * kInvPi};
}

void SphereMap::prepareSampling(Rgb factor) {
  const auto width = static_cast<std::size_t>(map_.width()), height = static_cast<std::size_t>(map_.height());
  sinSquaredHalf_.resize(height + 1);
  for (std::size_t y = 0; y <= height; ++y) {
    sinSquaredHalf_[y] =
        sqr(std::sin(std::numbers::pi / 2 * static_cast<double>(y) / static_cast<double>(height)));
  }
  std::vector<float> weights = map_.cellMeans(factor);
  for (std::size_t y = 0; y < height; ++y) {
    const auto area = static_cast<float>(sinSquaredHalf_[y + 1] - sinSquaredHalf_[y]);
    for (std::size_t x = 0; x < width; ++x) weights[y * width + x] *= area;
  }
  cells_ = Distribution2D(weights, width, height);
}

float SphereMap::pdfAt(Point2f uv) const {
  const auto height = sinSquaredHalf_.size() - 1;
  const double rowSolidAngle =
      4 * std::numbers::pi * (sinSquaredHalf_[rowOf(uv.y) + 1] - sinSquaredHalf_[rowOf(uv.y)]);
  return static_cast<float>(cells_.pdf(uv) / (static_cast<double>(height) * rowSolidAngle));
}

std::size_t SphereMap::rowOf(float v) const {
  const auto height = sinSquaredHalf_.size() - 1;
  return std::min(static_cast<std::size_t>(v * static_cast<float>(height)), height - 1);
}

SphereMap::Sample SphereMap::sample(Point2f u) const {
  const Point2f cell = cells_.sample(u).p;
  const std::size_t row = rowOf(cell.y);
  const double inRow = double{cell.y} * static_cast<double>(map_.height()) - static_cast<double>(row);
  // Uniform in solid angle inside the cell: cosθ = 1 - 2 sin²(θ/2), and the latter is a difference without
  // cancellation next to the upper pole.
  const double sin2 = lerp(inRow, sinSquaredHalf_[row], sinSquaredHalf_[row + 1]);
  const auto sinTheta = static_cast<float>(2 * safeSqrt(sin2 * (1 - sin2)));
  const float phi = 2 * kPi * cell.x;
  const Vector3f w{sinTheta * std::cos(phi), sinTheta * std::sin(phi), static_cast<float>(1 - 2 * sin2)};
  const auto v = static_cast<float>(2 * std::asin(std::sqrt(sin2)) / std::numbers::pi);
  return {w, map_.lookup({cell.x, v}), pdfAt(cell)};
}

}  // namespace pbrtmedia
