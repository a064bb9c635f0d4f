// SPDX-License-Identifier: BSD-2-Clause
#include "fields/grid_samples.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace pbrtmedia {
namespace {

/// A batch reads 64 bits where two halves lie.
constexpr std::int64_t kReadPadding = 4;

/// The power of 2 that brings the largest sample to [2^14, 2^15), as far as it is a normal float.
float halfScale(std::span<const float> density) {
  const float largest = density.empty() ? 0 : *std::max_element(density.begin(), density.end());
  if (!(largest > 0)) return 1;
  return std::ldexp(1.0f, std::max(std::ilogb(largest) - 14, -126));
}

std::uint16_t storedHalf(float value, float scale) {
  std::uint16_t code = HalfCode::encode(static_cast<double>(value) / static_cast<double>(scale));
  // Only the largest floats can round up to infinity.
  while (!std::isfinite(HalfCode::decode(code) * scale)) --code;
  return code;
}

}  // namespace

GridSamples::GridSamples(int nx, int ny, int nz, std::span<const float> density, GridBorder border,
                         GridPrecision precision, GridLayout layout)
    : n_{nx, ny, nz},
      layout_(std::int64_t{nx} + 2, std::int64_t{ny} + 2, std::int64_t{nz} + 2, layout,
              precision == GridPrecision::Half ? sizeof(std::uint16_t) : sizeof(float)) {
  if (precision == GridPrecision::Half) {
    view_.scale = halfScale(density);
    halves_.resize(static_cast<std::size_t>(layout_.stored() + kReadPadding));
    fill(
        halves_, [scale = view_.scale](float v) { return storedHalf(v, scale); }, density, border);
    view_.halves = halves_.data();
  } else {
    floats_.resize(static_cast<std::size_t>(layout_.stored()));
    fill(
        floats_, [](float v) { return v; }, density, border);
    view_.floats = floats_.data();
  }
  view_.x = layout_.x();
  view_.y = layout_.y();
  view_.z = layout_.z();
  view_.row = layout_.row();
  view_.slice = layout_.slice();
  view_.bricked = layout_.isBricked();
  view_.brickRow = layout_.brickRow();
  view_.brickSlice = layout_.brickSlice();
}

template <class T, class Store>
void GridSamples::fill(std::vector<T, HugePageAllocator<T>>& to, Store&& store,
                       std::span<const float> density, GridBorder border) const {
  const bool clamp = border == GridBorder::Clamp;
  const auto source = [](std::int64_t i, int n) { return std::clamp<std::int64_t>(i - 1, 0, n - 1); };
  const auto inApron = [](std::int64_t i, int n) { return i == 0 || i == n + std::int64_t{1}; };
  parallelFor(static_cast<std::size_t>(n_[2]) + 2, [&](std::size_t slice) {
    const auto k = static_cast<std::int64_t>(slice);
    std::vector<T> row(static_cast<std::size_t>(n_[0]) + 2);
    for (std::int64_t j = 0; j < n_[1] + std::int64_t{2}; ++j) {
      if (!clamp && (inApron(k, n_[2]) || inApron(j, n_[1]))) continue;  // stays 0
      const float* const from = density.data() + (source(k, n_[2]) * n_[1] + source(j, n_[1])) * n_[0];
      std::transform(from, from + n_[0], row.begin() + 1, store);
      if (clamp) {
        row.front() = row[1];
        row.back() = row[row.size() - 2];
      }
      layout_.eachRun(j, k, [&](std::int64_t i, std::int64_t count, std::int64_t at) {
        std::copy_n(row.begin() + i, count, to.begin() + at);
      });
    }
  });
}

}  // namespace pbrtmedia
