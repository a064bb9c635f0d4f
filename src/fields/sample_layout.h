// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pbrtmedia {

/// How the samples of a grid lie in memory.
enum class GridLayout {
  Automatic,  ///< bricked once the grid is far larger than a cache (SampleLayout::kBrickedFrom), else linear
  Linear,     ///< x fastest, then y, then z
  Bricked,    ///< bricks of 8^3 cells that hold all 9^3 samples around them: a cell never spans two bricks
};

/// Where sample (i, j, k), 0 <= i < count per axis, lies in an array. Both layouts are sums of one table
/// entry per axis, so a look-up does not know which it reads; and the eight samples around a cell lie at
/// fixed distances 1, row(), slice() from the first. Indices have 64 bits.
///
/// Bricks share their faces, which costs 736/512 = 1.44 times the memory, and more for grids thinner than a
/// brick. Beyond the cache a look-up then touches fewer cache lines and pages, and the next one along a ray
/// mostly the same (bench/layout_bench.cpp).
class SampleLayout {
 public:
  static constexpr std::int64_t kBrickCells = 8;    ///< per axis
  static constexpr std::int64_t kBrickEdge = 9;     ///< samples per axis
  static constexpr std::int64_t kBrickSlots = 736;  ///< 9^3 = 729 rounded up to whole cache lines
  /// Bytes of a linear grid from which bricks are faster. Measured: equal at 192^3 floats, 1.2 (one
  /// by one) to 1.3 times (batches) faster from 256^3 on, 1.05 to 1.25 times slower within a cache of 2 MiB.
  static constexpr std::int64_t kBrickedFrom = std::int64_t{32} << 20;
  /// Bricks that would cost more than this many times the memory are not chosen automatically.
  static constexpr double kWorthwhileCost = 1.6;

  SampleLayout() = default;
  /// `nx`, ...: samples per axis, >= 2, apron included; `sampleBytes`: of one stored value.
  SampleLayout(std::int64_t nx, std::int64_t ny, std::int64_t nz, GridLayout layout, std::size_t sampleBytes);

  bool isBricked() const { return bricked_; }
  const std::int64_t* x() const { return x_.data(); }
  const std::int64_t* y() const { return y_.data(); }
  const std::int64_t* z() const { return z_.data(); }
  std::int64_t index(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return x_[static_cast<std::size_t>(i)] + y_[static_cast<std::size_t>(j)] +
           z_[static_cast<std::size_t>(k)];
  }
  std::int64_t row() const { return row_; }             ///< from a sample of a cell to the one next in y
  std::int64_t slice() const { return slice_; }         ///< and next in z
  std::int64_t brickRow() const { return bricks_[0]; }  ///< bricks from one y to the next
  std::int64_t brickSlice() const { return bricks_[0] * bricks_[1]; }  ///< bricks from one z to the next
  std::int64_t stored() const { return stored_; }

  /// Calls copy(i, count, index) for every run of consecutive samples i, i + 1, ... of the row (j, k) and
  /// each place where they are stored. Different k never share a place.
  template <class Copy>
  void eachRun(std::int64_t j, std::int64_t k, Copy&& copy) const {
    if (!bricked_) {
      copy(std::int64_t{0}, count_[0], index(0, j, k));
      return;
    }
    eachBrick(k, bricks_[2], [&](std::int64_t bz, std::int64_t wz) {
      eachBrick(j, bricks_[1], [&](std::int64_t by, std::int64_t wy) {
        for (std::int64_t bx = 0; bx < bricks_[0]; ++bx) {
          const std::int64_t first = bx * kBrickCells;
          copy(first, std::min(kBrickEdge, count_[0] - first),
               (bz * brickSlice() + by * brickRow() + bx) * kBrickSlots + wz * slice_ + wy * row_);
        }
      });
    });
  }

 private:
  /// The one or two bricks along an axis that hold sample `i`, with its place in them.
  template <class Visit>
  static void eachBrick(std::int64_t i, std::int64_t bricks, Visit&& visit) {
    const std::int64_t brick = i / kBrickCells, within = i % kBrickCells;
    if (brick < bricks) visit(brick, within);
    if (within == 0 && brick > 0) visit(brick - 1, kBrickCells);
  }

  bool bricked_ = false;
  std::int64_t count_[3] = {}, bricks_[3] = {};
  std::int64_t row_ = 0, slice_ = 0, stored_ = 0;
  std::vector<std::int64_t> x_, y_, z_;
};

}  // namespace pbrtmedia
