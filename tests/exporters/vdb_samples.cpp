// SPDX-License-Identifier: BSD-2-Clause
#include "exporters/vdb_samples.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <memory>

#include "base/rng.h"

namespace pbrtmedia::test {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;

/// Values at `count` random voxels of the box and at its two corners; the same for the same seed.
template <class Grid>
void scatter(Grid& grid, const CoordBBox& box, int count, std::uint64_t seed) {
  Rng rng(seed);
  auto to = grid.getAccessor();
  const auto value = [&] { return static_cast<typename Grid::ValueType>(0.05 + rng.uniformDouble()); };
  const Coord size = box.dim();
  const auto along = [&](int n) { return static_cast<int>(rng.uniformInt(static_cast<std::uint32_t>(n))); };
  for (int i = 0; i < count; ++i) {
    to.setValue(box.min() + Coord(along(size.x()), along(size.y()), along(size.z())), value());
  }
  to.setValue(box.min(), value());
  to.setValue(box.max(), value());
}

/// Scattered voxels and a filled middle, so that neighbours interpolate.
void fillCloud(FloatGrid& grid) {
  scatter(grid, CoordBBox({-12, -3, 0}, {20, 15, 11}), 3000, 1);
  grid.fill(CoordBBox({-4, 0, 2}, {11, 9, 9}), 0.75f);
}

void place(FloatGrid& grid) {
  openvdb::Mat4d m = openvdb::Mat4d::identity();
  m.preScale(openvdb::Vec3d(0.5, 0.125, 0.2));
  m.postRotate(openvdb::math::X_AXIS, 0.4);
  m.postRotate(openvdb::math::Z_AXIS, -1.1);
  m.postShear(openvdb::math::X_AXIS, openvdb::math::Y_AXIS, 0.3);
  m.postTranslate(openvdb::Vec3d(10, -20, 5));
  grid.setTransform(openvdb::math::Transform::createLinearTransform(m));
}

FloatGrid::Ptr makeFloat(VdbKind kind) {
  FloatGrid::Ptr grid = FloatGrid::create(kind == VdbKind::Background ? 0.25f : 0.0f);
  grid->setName("density");
  grid->setGridClass(kind == VdbKind::LevelSet ? openvdb::GRID_LEVEL_SET : openvdb::GRID_FOG_VOLUME);
  auto to = grid->getAccessor();
  switch (kind) {
    case VdbKind::TilesOnly:
      grid->sparseFill(CoordBBox({-128, 0, 0}, {-1, 127, 127}), 0.5f);
      grid->sparseFill(CoordBBox({0, 8, 16}, {23, 15, 31}), 1.25f);
      break;
    case VdbKind::NegativeOrigin:
      scatter(*grid, CoordBBox({-66, -21, -90}, {59, 64, 63}), 20000, 2);
      break;
    case VdbKind::Empty:
      to.setValueOff(Coord(0, 0, 0), 0.0f);
      break;
    case VdbKind::OneVoxel:
      to.setValue(Coord(3, -4, 5), 2.0f);
      break;
    case VdbKind::Half:
      fillCloud(*grid);
      grid->setSaveFloatAsHalf(true);
      break;
    case VdbKind::Negative:
      fillCloud(*grid);
      to.setValue(Coord(-5, 0, 0), -0.5f);
      to.setValue(Coord(2, 3, 4), -0.25f);
      grid->sparseFill(CoordBBox({40, 0, 0}, {47, 7, 7}), -1.0f);
      break;
    case VdbKind::Inactive:
      fillCloud(*grid);
      to.setValueOff(Coord(5, 5, 5), 3.0f);
      break;
    case VdbKind::NotANumber:
      fillCloud(*grid);
      to.setValue(Coord(1, 2, 3), std::numeric_limits<float>::quiet_NaN());
      break;
    case VdbKind::NotFinite:
      fillCloud(*grid);
      to.setValue(Coord(1, 2, 3), std::numeric_limits<float>::quiet_NaN());
      grid->sparseFill(CoordBBox({40, 0, 0}, {47, 7, 7}), std::numeric_limits<float>::infinity());
      break;
    case VdbKind::LevelSet:
      fillCloud(*grid);
      to.setValue(Coord(2, 3, 4), -0.25f);
      break;
    case VdbKind::Frustum:
      fillCloud(*grid);
      grid->setTransform(openvdb::math::Transform::createFrustumTransform(
          openvdb::BBoxd(openvdb::Vec3d(0.0), openvdb::Vec3d(10.0)), 0.5, 3.0, 1.0));
      break;
    default:
      fillCloud(*grid);
      break;
  }
  if (kind == VdbKind::Placed || kind == VdbKind::Background || kind == VdbKind::TilesOnly) place(*grid);
  return grid;
}

openvdb::GridBase::Ptr make(VdbKind kind) {
  openvdb::initialize();
  if (kind == VdbKind::SphereLevelSet) {
    const FloatGrid::Ptr grid =
        openvdb::tools::createLevelSetSphere<FloatGrid>(1.0f, openvdb::Vec3f(2, 0, 0), 0.1f);
    grid->setName("surface");
    return grid;
  }
  if (kind != VdbKind::Double) return makeFloat(kind);
  openvdb::DoubleGrid::Ptr grid = openvdb::DoubleGrid::create(0.0);
  grid->setName("density");
  scatter(*grid, CoordBBox({0, 0, 0}, {15, 9, 12}), 800, 3);
  return grid;
}

}  // namespace

void writeVdb(const std::filesystem::path& file, VdbKind kind) {
  openvdb::GridPtrVec grids{make(kind)};
  openvdb::io::File(file.string()).write(grids);
}

void writeVdbStream(const std::filesystem::path& file, VdbKind kind) {
  const openvdb::GridPtrVec grids{make(kind), make(VdbKind::OneVoxel)};
  std::ofstream out(file, std::ios::binary);
  openvdb::io::Stream(out).write(grids);
}

void writeVdbOfManyGrids(const std::filesystem::path& file) {
  openvdb::GridPtrVec grids;
  const auto add = [&](VdbKind kind, const std::string& name) {
    grids.push_back(make(kind));
    grids.back()->setName(name);
  };
  add(VdbKind::Placed, "density");
  add(VdbKind::Half, "");
  add(VdbKind::OneVoxel, "density");
  add(VdbKind::NegativeOrigin, "with \"quotes\"");
  add(VdbKind::TilesOnly, "temperature");
  openvdb::Vec3SGrid::Ptr vectors = openvdb::Vec3SGrid::create();
  vectors->setName("v");
  vectors->fill(CoordBBox({0, 0, 0}, {3, 3, 3}), openvdb::Vec3s(1.0f));
  grids.push_back(vectors);
  openvdb::io::File(file.string()).write(grids);
}

void writeFireVdb(const std::filesystem::path& file, float hottest) {
  openvdb::initialize();
  const auto filled = [](const char* name, double voxel, const CoordBBox& box, float value) {
    FloatGrid::Ptr grid = FloatGrid::create(0.0f);
    grid->setName(name);
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
    grid->fill(box, value);
    return grid;
  };
  openvdb::Vec3SGrid::Ptr vectors = openvdb::Vec3SGrid::create();
  vectors->setName("vel");
  vectors->fill(CoordBBox({0, 0, 0}, {3, 3, 3}), openvdb::Vec3s(1.0f));
  openvdb::BoolGrid::Ptr mask = openvdb::BoolGrid::create(false);
  mask->setName("mask");
  mask->fill(CoordBBox({0, 0, 0}, {3, 3, 3}), true);
  const openvdb::GridPtrVec grids = {filled("temperature", 0.2, CoordBBox({-5, 1, -5}, {5, 5, 5}), hottest),
                                     filled("density", 0.1, CoordBBox({-10, -10, -10}, {9, 9, 9}), 1),
                                     filled("heat", 0.1, CoordBBox({-10, -10, -10}, {9, -2, 9}), 0.5f),
                                     vectors, mask};
  openvdb::io::File(file.string()).write(grids);
}

std::vector<double> sampledByOpenVdb(const std::filesystem::path& path, int number,
                                     const std::vector<Vec3d>& world) {
  openvdb::initialize();
  openvdb::io::File file(path.string());
  file.open(/*delayLoad=*/false);
  const openvdb::GridPtrVecPtr grids = file.getGrids();
  const openvdb::GridBase::Ptr grid = grids->at(static_cast<std::size_t>(number));
  std::vector<double> values;
  const auto sample = [&](const auto& typed) {
    const openvdb::tools::GridSampler<std::decay_t<decltype(typed)>, openvdb::tools::BoxSampler> sampler(
        typed);
    for (const Vec3d& p : world) {
      values.push_back(static_cast<double>(sampler.wsSample(openvdb::Vec3d(p.x, p.y, p.z))));
    }
  };
  if (const auto floats = openvdb::gridPtrCast<FloatGrid>(grid)) sample(*floats);
  if (const auto doubles = openvdb::gridPtrCast<openvdb::DoubleGrid>(grid)) sample(*doubles);
  return values;
}

}  // namespace pbrtmedia::test
