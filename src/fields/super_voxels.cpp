// SPDX-License-Identifier: BSD-2-Clause
#include "fields/super_voxels.h"

#include <algorithm>

#include "base/parallel.h"

namespace pbrtmedia {
namespace {

/// Smallest and largest cell numbers that are not empty, per axis.
struct Occupancy {
  Vec3<std::int64_t> first, last;
  std::size_t empty = 0;
  bool any = false;
};

Occupancy survey(const LatticeShape& shape, const std::vector<SuperVoxel>& cells) {
  Occupancy o;
  for (std::int64_t k = 0; k < shape.count.z; ++k) {
    for (std::int64_t j = 0; j < shape.count.y; ++j) {
      for (std::int64_t i = 0; i < shape.count.x; ++i) {
        if (!(cells[static_cast<std::size_t>(shape.index(i, j, k))].upper > 0)) {
          ++o.empty;
          continue;
        }
        const Vec3<std::int64_t> at(i, j, k);
        o.first = o.any ? min(o.first, at) : at;
        o.last = o.any ? max(o.last, at) : at;
        o.any = true;
      }
    }
  }
  return o;
}

}  // namespace

SuperVoxels::SuperVoxels(const LatticeShape& shape, double cellSize, const Bounds3d& box,
                         const std::function<SuperVoxel(std::int64_t, std::int64_t, std::int64_t)>& boundOf)
    : shape_(shape), cellSize_(cellSize), inverseCellSize_(1 / cellSize) {
  cells_.resize(static_cast<std::size_t>(shape.stored()));
  parallelFor(static_cast<std::size_t>(shape.count.y * shape.count.z), [&](std::size_t row) {
    const auto j = static_cast<std::int64_t>(row) % shape.count.y;
    const auto k = static_cast<std::int64_t>(row) / shape.count.y;
    SuperVoxel* out = cells_.data() + shape.index(0, j, k);
    for (std::int64_t i = 0; i < shape.count.x; ++i) out[i] = boundOf(i, j, k);
  });
  for (const SuperVoxel& cell : cells_) maximum_ = std::max(maximum_, cell.upper);
  const Occupancy occupancy = survey(shape_, cells_);
  emptyCells_ = occupancy.empty;
  if (!occupancy.any) return;  // `occupied_` stays empty
  occupied_.min = max(box.min, Vec3d(occupancy.first) * cellSize);
  occupied_.max = min(box.max, Vec3d(occupancy.last + Vec3<std::int64_t>(1, 1, 1)) * cellSize);
}

}  // namespace pbrtmedia
