// SPDX-License-Identifier: BSD-2-Clause
#include "fields/sample_layout.h"

namespace pbrtmedia {
namespace {

/// Place of each sample of an axis relative to sample 0. `gap`: from a sample to the next inside a brick (or
/// at all, when `brick` is 0); `brick`: from one brick to the next.
std::vector<std::int64_t> axisTable(std::int64_t count, std::int64_t gap, std::int64_t brick) {
  std::vector<std::int64_t> table(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    // The last sample begins no cell: it is the far end of the last one.
    const std::int64_t cell = std::min(i, count - 2);
    const std::int64_t at =
        brick == 0 ? cell * gap
                   : cell / SampleLayout::kBrickCells * brick + cell % SampleLayout::kBrickCells * gap;
    table[static_cast<std::size_t>(i)] = at + (i - cell) * gap;
  }
  return table;
}

}  // namespace

SampleLayout::SampleLayout(std::int64_t nx, std::int64_t ny, std::int64_t nz, GridLayout layout,
                           std::size_t sampleBytes)
    : count_{nx, ny, nz} {
  for (int a = 0; a < 3; ++a) bricks_[a] = (count_[a] - 1 + kBrickCells - 1) / kBrickCells;
  const std::int64_t linear = nx * ny * nz, bricked = bricks_[0] * bricks_[1] * bricks_[2] * kBrickSlots;
  bricked_ =
      layout == GridLayout::Bricked ||
      (layout == GridLayout::Automatic && linear * static_cast<std::int64_t>(sampleBytes) >= kBrickedFrom &&
       static_cast<double>(bricked) <= kWorthwhileCost * static_cast<double>(linear));
  stored_ = bricked_ ? bricked : linear;
  row_ = bricked_ ? kBrickEdge : nx;
  slice_ = bricked_ ? kBrickEdge * kBrickEdge : nx * ny;
  x_ = axisTable(nx, 1, bricked_ ? kBrickSlots : 0);
  y_ = axisTable(ny, row_, bricked_ ? brickRow() * kBrickSlots : 0);
  z_ = axisTable(nz, slice_, bricked_ ? brickSlice() * kBrickSlots : 0);
}

}  // namespace pbrtmedia
