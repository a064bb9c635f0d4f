// SPDX-License-Identifier: BSD-2-Clause
#include "fields/grid_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pbrtmedia {
namespace {

/// Relative slack of bounds for the rounding of a look-up: three nested float interpolations, each off by at
/// most 3 ulp of the largest sample, stay below 9 * 2^-24; this is 16 * 2^-24.
constexpr float kLookupRounding = 0x1p-20f;

/// One axis of the mean: how much of each cell's part inside the box each of its samples stands for. The
/// integral of a trilinear interpolant is a sum of samples times such weights, one factor per axis.
class AxisWeights {
 public:
  AxisWeights(std::int64_t n, std::int64_t size)
      : n_(n),
        size_(size),
        cells_((n + size) / size),
        weights_(static_cast<std::size_t>(cells_ * (size + 1))) {
    for (std::int64_t cell = 0; cell < cells_; ++cell) fill(cell);
  }

  std::int64_t cells() const { return cells_; }
  /// Samples of the closed cell, apron included.
  std::int64_t first(std::int64_t cell) const { return cell * size_; }
  std::int64_t last(std::int64_t cell) const { return std::min((cell + 1) * size_, n_ + 1); }
  /// Weight of sample first(cell) + i; those of a cell add up to 1.
  double operator()(std::int64_t cell, std::int64_t i) const {
    return weights_[static_cast<std::size_t>(cell * (size_ + 1) + i)];
  }

 private:
  void fill(std::int64_t cell) {
    double* const weights = weights_.data() + cell * (size_ + 1);
    double length = 0;
    for (std::int64_t gap = first(cell); gap < last(cell); ++gap) {
      // The part [u0, u1] of the gap that lies inside the box [1/2, n + 1/2].
      const double u0 = gap == 0 ? 0.5 : 0, u1 = gap == n_ ? 0.5 : 1;
      const double toFar = (u1 * u1 - u0 * u0) / 2;  // integral of u
      weights[gap - first(cell)] += u1 - u0 - toFar;
      weights[gap - first(cell) + 1] += toFar;
      length += u1 - u0;
    }
    for (std::int64_t i = 0; i <= size_; ++i) weights[i] /= length;
  }

  std::int64_t n_, size_, cells_;
  std::vector<double> weights_;
};

}  // namespace

SuperVoxel withRoundingSlack(float lower, float upper, double mean) {
  // Equal samples are interpolated exactly.
  if (lower == upper) return {upper, lower, upper};
  constexpr float kLargest = std::numeric_limits<float>::max();
  // The mean of samples that are not all 0 is positive, even where float cannot hold it.
  const float positive = std::max(std::numeric_limits<float>::denorm_min(), lower);
  return {std::min(std::nextafter(upper * (1 + kLookupRounding), kLargest), kLargest),
          std::nextafter(lower * (1 - kLookupRounding), 0.0f),
          std::clamp(static_cast<float>(mean), positive, upper)};
}

SuperVoxels gridBounds(const GridSamples& samples, int nx, int ny, int nz, Vec3<std::int64_t> size) {
  // n + 1 gaps between the n + 2 samples of an axis, apron included.
  const AxisWeights x(nx, size.x), y(ny, size.y), z(nz, size.z);
  const LatticeShape shape{{x.cells(), y.cells(), z.cells()}};
  const Bounds3d box{{0.5, 0.5, 0.5}, {nx + 0.5, ny + 0.5, nz + 0.5}};
  const auto boundOf = [&](std::int64_t ci, std::int64_t cj, std::int64_t ck) {
    // Interpolation never leaves the range of the samples around, so those of the closed cell bound it.
    float lower = std::numeric_limits<float>::infinity(), upper = 0;
    double mean = 0;
    for (std::int64_t k = z.first(ck); k <= z.last(ck); ++k) {
      for (std::int64_t j = y.first(cj); j <= y.last(cj); ++j) {
        double along = 0;
        for (std::int64_t i = x.first(ci); i <= x.last(ci); ++i) {
          const float value = samples.at(i, j, k);
          lower = std::min(lower, value);
          upper = std::max(upper, value);
          along += x(ci, i - x.first(ci)) * static_cast<double>(value);
        }
        mean += along * y(cj, j - y.first(cj)) * z(ck, k - z.first(ck));
      }
    }
    return withRoundingSlack(lower, upper, mean);
  };
  return SuperVoxels({shape, Vec3d(size), box}, boundOf);
}

}  // namespace pbrtmedia
