// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/vdb_density.h"

#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "vdb2pbrt/vdb_density_grid.h"

namespace pbrtmedia {
namespace {

VoxelIndex indexOf(const openvdb::Coord& c) { return {c.x(), c.y(), c.z()}; }
openvdb::Coord coordOf(VoxelIndex i) {
  return {static_cast<int>(i.x), static_cast<int>(i.y), static_cast<int>(i.z)};
}

Transform transformOf(const openvdb::math::Transform& transform) {
  const openvdb::Mat4d m = transform.baseMap()->getAffineMap()->getMat4();  // for row vectors
  Matrix4 result;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      result.m[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = m(column, row);
    }
  }
  return Transform(result);
}

/// Calls visit(value&, where, voxels) for every stored value: tiles first, then the voxels of leaves.
template <class Tree, class Visit>
void forEachValue(Tree& tree, const Visit& visit) {
  auto tile = tree.beginValueAll();
  tile.setMaxDepth(tile.getLeafDepth() - 1);
  for (; tile; ++tile) {
    float value = *tile;
    if (visit(value, tile.getCoord(), tile.getVoxelCount())) {
      if constexpr (!std::is_const_v<Tree>) tile.setValue(value);
    }
  }
  for (auto leaf = tree.beginLeaf(); leaf; ++leaf) {
    for (openvdb::Index i = 0; i < std::decay_t<decltype(*leaf)>::SIZE; ++i) {
      float value = leaf->getValue(i);
      if (visit(value, leaf->offsetToGlobalCoord(i), openvdb::Index64{1})) {
        if constexpr (!std::is_const_v<Tree>) leaf->setValueOnly(i, value);
      }
    }
  }
}

}  // namespace

VdbDensity::VdbDensity(std::unique_ptr<Grid> grid) : grid_(std::move(grid)) { readFacts(); }
VdbDensity::VdbDensity(VdbDensity&&) noexcept = default;
VdbDensity& VdbDensity::operator=(VdbDensity&&) noexcept = default;
VdbDensity::~VdbDensity() = default;

void VdbDensity::readFacts() {
  const openvdb::FloatGrid& grid = *grid_->grid;
  name_ = grid.getName();
  isLevelSet_ = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  activeVoxels_ = grid.activeVoxelCount();
  background_ = grid.background();
  if (const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox(); !box.empty()) {
    activeMin_ = indexOf(box.min());
    activeMax_ = indexOf(box.max());
  }
  if (!grid.transform().isLinear()) {
    throw std::runtime_error("grid \"" + name_ +
                             "\" has a frustum transformation; only affine ones (moved, rotated, scaled, "
                             "sheared) can be converted");
  }
  worldFromIndex_ = transformOf(grid.transform());
  if (worldFromIndex_.isSingular()) {
    throw std::runtime_error("grid \"" + name_ + "\" has a transformation without inverse");
  }
}

VdbDensity::Range VdbDensity::range() const {
  Range range{background_, background_};
  forEachValue(std::as_const(grid_->grid->tree()), [&](float v, const openvdb::Coord&, openvdb::Index64) {
    range.min = std::min(range.min, v);
    range.max = std::max(range.max, v);
    return false;
  });
  return range;
}

VdbDensity::Negatives VdbDensity::checkValues(NegativeRule rule) {
  Negatives found;
  const auto refuse = [&](const std::string& where, float value, const char* expected) {
    std::ostringstream message;
    message << "grid \"" << name_ << "\": " << where << " is " << value << ", expected " << expected;
    throw std::runtime_error(message.str());
  };
  const auto shown = [](const openvdb::Coord& c) {
    std::ostringstream text;
    text << "voxel (" << c.x() << ", " << c.y() << ", " << c.z() << ')';
    return text.str();
  };
  forEachValue(grid_->grid->tree(), [&](float& v, const openvdb::Coord& at, openvdb::Index64 voxels) {
    if (!std::isfinite(v)) refuse(shown(at), v, "a finite number");
    if (!(v < 0)) return false;
    if (rule == NegativeRule::Error) refuse(shown(at), v, ">= 0 (--negative clamp makes it 0)");
    if (found.count == 0) {
      found.first = indexOf(at);
      found.firstValue = v;
    }
    found.count += voxels;
    v = 0;
    return rule == NegativeRule::Clamp;
  });
  if (!std::isfinite(background_)) refuse("the background", background_, "a finite number");
  if (background_ < 0) {
    if (rule == NegativeRule::Error)
      refuse("the background", background_, ">= 0 (--negative clamp makes it 0)");
    if (rule == NegativeRule::Clamp) {
      grid_->grid->tree().root().setBackground(0.0f, /*updateChildNodes=*/true);
      background_ = 0;
    }
  }
  return found;
}

std::vector<float> VdbDensity::samples(VoxelIndex lo, VoxelIndex hi) const {
  using Dense = openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ>;  // x fastest
  const openvdb::CoordBBox box(coordOf(lo), coordOf(hi));
  std::vector<float> values(box.volume());
  Dense dense(box, values.data());
  openvdb::tools::copyToDense(*grid_->grid, dense);
  return values;
}

}  // namespace pbrtmedia
