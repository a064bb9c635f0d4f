// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

#include "base/bounds.h"
#include "base/vec.h"
#include "fields/interval.h"

namespace pbrtmedia {

/// Gradient noise in [-1.5, 1.5] on the unit lattice without a period: Perlin 2002,
/// doi:10.1145/566654.566636 (twelve gradients, quintic blend), with gradients from an integer hash of the
/// lattice point and a seed. Twice continuously differentiable, 0 at lattice points. In double, so that
/// twelve octaves far from the origin keep their digits; |p| < 2^50.
class GradientNoise {
 public:
  static constexpr double kLimit = 1.5;  ///< three axes, each weighing at most 1/2

  explicit GradientNoise(std::uint32_t seed = 0) : seed_(seed) {}

  double at(Vec3d p) const;
  /// A range that holds the noise over the box: tight for boxes much smaller than a lattice cell, of first
  /// order in their size; everything the noise can be for boxes of a cell and more.
  Interval range(const Bounds3d& box) const;

 private:
  std::uint32_t hash(std::int64_t x, std::int64_t y, std::int64_t z) const;

  std::uint32_t seed_;
};

}  // namespace pbrtmedia
