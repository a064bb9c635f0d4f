// SPDX-License-Identifier: BSD-2-Clause
#include "fields/nano_vdb_field.h"

#include <cmath>
#include <sstream>

#include "base/diagnostics.h"
#include "fields/grid_bounds.h"

namespace pbrtmedia {
namespace {

[[noreturn]] void refuseField(const std::string& what) {
  throw SceneError(SourceLocation{}, "nanovdb field: " + what);
}

NanoVdbGrid load(const NanoVdbField::Params& params) {
  if (!std::isfinite(params.map.scale) || params.map.scale < 0) {
    refuseField("the density scale must be finite and >= 0; found " + std::to_string(params.map.scale));
  }
  if (!std::isfinite(params.map.offset)) refuseField("the density offset must be finite");
  const NanoVdbFile file(params.file);
  const std::vector<GridCandidate> candidates = file.candidates();
  return readNanoVdbGrid(file, chooseGrid(candidates, params.grid), params.map);
}

}  // namespace

NanoVdbField::NanoVdbField(const Params& params, const Transform& worldFromMedium) {
  NanoVdbGrid grid = load(params);
  if (worldFromMedium.isSingular()) refuseField("the transform to world space has no inverse");
  name_ = grid.name;
  type_ = grid.type;
  isEmpty_ = !grid.hasActive;
  if (isEmpty_) {  // one clear voxel
    grid.activeMin = grid.activeMax = {};
    grid.treeOrigin = {-4096, -4096, -4096};
    grid.tree = BrickTree({2, 2, 2}, 0);
  }
  activeMin_ = grid.activeMin;
  activeMax_ = grid.activeMax;
  tree_ = std::move(grid.tree);

  // Local 0 is a corner of a brick, at least 2 voxels below the active ones: the box begins at 1 or more, and
  // a point a quarter outside of it is still positive.
  Vec3d origin;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t zero = (activeMin_[a] - 2) & ~std::int64_t{7};
    shift_[a] = zero - grid.treeOrigin[a];
    gaps_[a] = activeMax_[a] + 1 - zero;
    origin[a] = static_cast<double>(zero);
    box_.min[a] = static_cast<double>(activeMin_[a] - 1 - zero);
    box_.max[a] = static_cast<double>(gaps_[a]);
  }
  worldFromLocal_ = worldFromMedium * grid.worldFromIndex * Transform::translate(origin);
  localFromWorld_ = AffineMap(worldFromLocal_.inverseMatrix());
}

float NanoVdbField::densityAt(Vec3d world) const {
  const Vec3d p = localFromWorld_.point(world);
  return box_.contains(p) ? density(p) : 0;
}

SuperVoxelLattice NanoVdbField::lattice(const WantedCells& wanted) const {
  if (wanted) {
    return latticeOf({gapsPerCell(gaps_.x, (*wanted)[0]), gapsPerCell(gaps_.y, (*wanted)[1]),
                      gapsPerCell(gaps_.z, (*wanted)[2])});
  }
  const auto cells = [&](int power) {
    double count = 1;
    for (std::size_t a = 0; a < 3; ++a) count *= std::ceil(std::ldexp(static_cast<double>(gaps_[a]), -power));
    return count;
  };
  int power = kFinestSuperVoxelPower;
  while (power < kMaxSuperVoxelPower && cells(power) > static_cast<double>(kMaxSuperVoxels)) ++power;
  const std::int64_t size = std::int64_t{1} << power;
  return latticeOf({size, size, size});
}

SuperVoxelLattice NanoVdbField::latticeOf(const Vec3<std::int64_t>& voxelsPerCell) const {
  SuperVoxelLattice lattice{.cellSize = Vec3d(voxelsPerCell), .box = box_};
  for (std::size_t a = 0; a < 3; ++a) {
    lattice.shape.count[a] = (gaps_[a] + voxelsPerCell[a] - 1) / voxelsPerCell[a];
  }
  return lattice;
}

SuperVoxels NanoVdbField::superVoxels(int power) const {
  if (power < 0 || power > kMaxSuperVoxelPower) {
    refuseField("a super-voxel spans 2^p voxels, p from 0 to " + std::to_string(kMaxSuperVoxelPower) +
                "; found p = " + std::to_string(power));
  }
  const std::int64_t size = std::int64_t{1} << power;
  return superVoxels(latticeOf({size, size, size}));
}

SuperVoxels NanoVdbField::superVoxels(const SuperVoxelLattice& lattice) const {
  const Vec3<std::int64_t> size(lattice.cellSize);
  const Vec3<std::int64_t> boxMin(static_cast<std::int64_t>(box_.min.x),
                                  static_cast<std::int64_t>(box_.min.y),
                                  static_cast<std::int64_t>(box_.min.z));
  // Interpolation never leaves the range of the samples around, so the samples of the closed cell bound it.
  const auto boundOfCell = [&](std::int64_t i, std::int64_t j, std::int64_t k) -> SuperVoxel {
    const Vec3<std::int64_t> cell(i, j, k);
    BrickTree::Corner lo, hi;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t first = std::max(cell[a] * size[a], boxMin[a]);
      const std::int64_t last = std::min((cell[a] + 1) * size[a], gaps_[a]);
      if (first > last) return {0, 0, 0};  // outside the box
      lo[a] = static_cast<std::uint64_t>(first + shift_[a]);
      hi[a] = static_cast<std::uint64_t>(last + shift_[a]);
    }
    const BrickTree::Summary samples = tree_.summary(lo, hi);
    return withRoundingSlack(samples.lower, samples.upper, samples.mean);
  };
  return SuperVoxels(lattice, boundOfCell);
}

std::string NanoVdbField::describe() const {
  std::ostringstream text;
  text << "nanovdb grid \"" << name_ << "\" (" << type_ << "), ";
  if (isEmpty_) {
    text << "no active voxels: clear";
  } else {
    text << "voxels " << activeMin_ << ".." << activeMax_ << ", " << tree_.brickCount() << " bricks";
  }
  return text.str();
}

}  // namespace pbrtmedia
