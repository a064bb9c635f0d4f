// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/vdb_density.h"

#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <algorithm>
#include <array>
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

VdbDensity::Findings VdbDensity::checkValues(NegativeRule negative, NanRule nan) {
  Findings found;
  const auto note = [](Finding& finding, const openvdb::Coord& at, float value, openvdb::Index64 voxels) {
    if (finding.count == 0) {
      finding.first = indexOf(at);
      finding.firstValue = value;
    }
    finding.count += voxels;
  };
  forEachValue(std::as_const(grid_->grid->tree()),
               [&](float v, const openvdb::Coord& at, openvdb::Index64 voxels) {
                 if (!std::isfinite(v)) {
                   note(found.notFinite, at, v, voxels);
                 } else if (v < 0) {
                   note(found.negative, at, v, voxels);
                 }
                 return false;
               });
  const auto refuse = [&](const Finding& finding, float background, const std::string& expected) {
    std::ostringstream message;
    message << "grid \"" << name_ << "\": ";
    if (finding.count > 0) {
      message << "voxel (" << finding.first.x << ", " << finding.first.y << ", " << finding.first.z << ") is "
              << finding.firstValue;
      if (finding.count > 1) message << ", and " << finding.count - 1 << " more like it";
    } else {
      message << "the background is " << background;
    }
    throw std::runtime_error(message.str() + ", expected " + expected);
  };
  if (nan == NanRule::Error && (found.notFinite.count > 0 || !std::isfinite(background_))) {
    refuse(found.notFinite, background_, "finite numbers (--nan zero makes them 0)");
  }
  if (negative == NegativeRule::Error && (found.negative.count > 0 || background_ < 0)) {
    refuse(found.negative, background_, ">= 0 (--negative clamp makes it 0)");
  }
  const auto isBad = [&](float v) { return !std::isfinite(v) || (v < 0 && negative == NegativeRule::Clamp); };
  if (found.notFinite.count + found.negative.count > 0) {
    forEachValue(grid_->grid->tree(), [&](float& v, const openvdb::Coord&, openvdb::Index64) {
      const bool bad = isBad(v);
      if (bad) v = 0;
      return bad;
    });
  }
  if (isBad(background_)) {
    grid_->grid->tree().root().setBackground(0.0f, /*updateChildNodes=*/true);
    background_ = 0;
  }
  return found;
}

void VdbDensity::makeFog() {
  if (!(background_ > 0)) {
    throw std::runtime_error("grid \"" + name_ +
                             "\" is a level set without a band: its background is not above 0");
  }
  openvdb::tools::sdfToFogVolume(*grid_->grid);
  readFacts();
}

float VdbDensity::quantile(double q) const {
  const float most = range().max;
  if (!(most > 0) || !std::isfinite(most)) return 0;
  constexpr int kBins = 4096;
  std::array<std::uint64_t, kBins> bins{};
  std::uint64_t total = 0;
  for (auto value = grid_->grid->cbeginValueOn(); value; ++value) {
    if (!(*value > 0)) continue;
    const int bin = std::min(kBins - 1, static_cast<int>(*value / most * kBins));
    bins[static_cast<std::size_t>(bin)] += value.getVoxelCount();
    total += value.getVoxelCount();
  }
  if (total == 0) return 0;
  double sum = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    sum += static_cast<double>(bins[static_cast<std::size_t>(bin)]);
    if (sum >= q * static_cast<double>(total)) return most * static_cast<float>(bin + 1) / kBins;
  }
  return most;
}

double VdbDensity::integral(Vec3d from, Vec3d to, int steps) const {
  const Vec3d a = worldFromIndex_.inverse().point(from), b = worldFromIndex_.inverse().point(to);
  const auto accessor = grid_->grid->getConstAccessor();
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const Vec3d p = a + ((i + 0.5) / steps) * (b - a);
    const float v = openvdb::tools::BoxSampler::sample(accessor, openvdb::Vec3d(p.x, p.y, p.z));
    if (v > 0 && std::isfinite(v)) sum += static_cast<double>(v);
  }
  return sum * length(to - from) / steps;
}

double VdbDensity::shareOutside(const VdbDensity& density, float threshold) const {
  constexpr std::uint64_t kLooks = 100000;
  const std::uint64_t stride = 1 + activeVoxels_ / kLooks;
  const Transform otherFromIndex = density.worldFromIndex_.inverse() * worldFromIndex_;
  const auto accessor = density.grid_->grid->getConstAccessor();
  std::uint64_t number = 0, looked = 0, outside = 0;
  for (auto value = grid_->grid->cbeginValueOn(); value; ++value) {
    if (!(*value > threshold) || number++ % stride != 0) continue;
    const openvdb::Coord c = value.getCoord();
    const Vec3d p = otherFromIndex.point(Vec3d(c.x(), c.y(), c.z()));
    ++looked;
    outside += openvdb::tools::BoxSampler::sample(accessor, openvdb::Vec3d(p.x, p.y, p.z)) > 0 ? 0u : 1u;
  }
  return looked == 0 ? 0 : static_cast<double>(outside) / static_cast<double>(looked);
}

Bounds3d VdbDensity::worldBox() const {
  Bounds3d box;
  if (activeVoxels_ == 0) return box;
  const Bounds3d inIndex{Vec3d(activeMin_) - Vec3d(1, 1, 1), Vec3d(activeMax_) + Vec3d(1, 1, 1)};
  for (int i = 0; i < 8; ++i) box.expand(worldFromIndex_.point(inIndex.corner(i)));
  return box;
}

std::vector<float> VdbDensity::samplesAt(const Transform& worldFromOther, VoxelIndex lo,
                                         VoxelIndex hi) const {
  if (worldFromOther == worldFromIndex_) return samples(lo, hi);
  const Transform here = worldFromIndex_.inverse() * worldFromOther;
  const auto accessor = grid_->grid->getConstAccessor();
  std::vector<float> values;
  for (std::int64_t k = lo.z; k <= hi.z; ++k) {
    for (std::int64_t j = lo.y; j <= hi.y; ++j) {
      for (std::int64_t i = lo.x; i <= hi.x; ++i) {
        const Vec3d p = here.point(Vec3d(VoxelIndex(i, j, k)));
        values.push_back(openvdb::tools::BoxSampler::sample(accessor, openvdb::Vec3d(p.x, p.y, p.z)));
      }
    }
  }
  return values;
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
