// SPDX-License-Identifier: BSD-2-Clause
#include "fields/procedural_field.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/diagnostics.h"
#include "fields/field_box.h"

namespace pbrtmedia {
namespace {

/// The least float that is not below a double, and a hair more: ranges are right up to rounding.
float above(double v) {
  if (!(v > 0)) return 0;
  return std::nextafter(static_cast<float>(v * (1 + 1e-6)), std::numeric_limits<float>::infinity());
}
float below(double v) {
  return v > 0 ? std::max(0.0f, std::nextafter(static_cast<float>(v * (1 - 1e-6)), 0.0f)) : 0.0f;
}

/// Of points of a line, whichever way they are computed, relative to the coordinates.
constexpr double kPointRounding = 0x1p-49;

}  // namespace

ProceduralField::ProceduralField(const Params& params, const Transform& worldFromMedium) : params_(params) {
  for (const int n : params.cells) {
    if (n < 1 || n > 1024) {
      throw SceneError(SourceLocation{},
                       "super-voxels per axis: found " + std::to_string(n) + ", expected 1 to 1024");
    }
  }
  const Transform cube = worldFromUnitCube(params.p0, params.p1, worldFromMedium, params.typeName);
  const auto n = [&](std::size_t i) { return 1.0 / params.cells[i]; };
  worldFromLocal_ = cube * Transform::scale(n(0), n(1), n(2));
  localFromWorld_ = AffineMap(worldFromLocal_.inverseMatrix());
  // Straight from the corners: no way through the world, which may be far away.
  const Vec3d p0(params.p0), d = Vec3d(params.p1) - p0;
  mediumFromLocal_.x = {d.x * n(0), 0, 0};
  mediumFromLocal_.y = {0, d.y * n(1), 0};
  mediumFromLocal_.z = {0, 0, d.z * n(2)};
  mediumFromLocal_.t = p0;
}

float ProceduralField::densityAt(Point3f world) const {
  const Vec3d local = localFromWorld_.point(Vec3d(world));
  return localBox().contains(local) ? density(local) : 0;
}

Bounds3d ProceduralField::localBox() const {
  return {{0, 0, 0},
          {static_cast<double>(params_.cells[0]), static_cast<double>(params_.cells[1]),
           static_cast<double>(params_.cells[2])}};
}

SuperVoxelLattice ProceduralField::lattice(const WantedCells& wanted) const {
  SuperVoxelLattice lattice{.box = localBox()};
  for (std::size_t a = 0; a < 3; ++a) {
    const int count = wanted ? std::max(1, (*wanted)[a]) : params_.cells[a];
    lattice.shape.count[a] = count;
    lattice.cellSize[a] = static_cast<double>(params_.cells[a]) / count;
  }
  return lattice;
}

std::optional<SuperVoxels> ProceduralField::superVoxels(const SuperVoxelLattice& lattice) const {
  if (!params_.function->range({mediumFromLocal_.point({0, 0, 0}), mediumFromLocal_.point({0, 0, 0})})) {
    return std::nullopt;
  }
  constexpr int kParts = 1 << kHalvings;
  const Vec3d size = lattice.cellSize;
  return SuperVoxels(lattice, [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    double lower = std::numeric_limits<double>::infinity(), upper = 0, middle = 0;
    for (int part = 0; part < kParts * kParts * kParts; ++part) {
      const int x = part % kParts, y = part / kParts % kParts, z = part / (kParts * kParts);
      const auto at = [&](Vec3d p) {
        return Vec3d((static_cast<double>(i) + p.x / kParts) * size.x,
                     (static_cast<double>(j) + p.y / kParts) * size.y,
                     (static_cast<double>(k) + p.z / kParts) * size.z);
      };
      // Points of a line may lie a rounding outside of their cell.
      const Vec3d hair = size * 1e-9;
      const Vec3d a = mediumFromLocal_.point(at(Vec3d(x, y, z)) - hair),
                  b = mediumFromLocal_.point(at(Vec3d(x + 1, y + 1, z + 1)) + hair);
      const Interval range = *params_.function->range({min(a, b), max(a, b)});
      lower = std::min(lower, range.lo);
      upper = std::max(upper, range.hi);
      middle += (range.lo + range.hi) / 2;
    }
    return SuperVoxel{above(upper), below(lower), static_cast<float>(middle / (kParts * kParts * kParts))};
  });
}

SuperVoxel ProceduralField::rangeOn(const LocalLine& line, double sEnter, double sExit) const {
  const auto at = [&](double s) { return mediumFromLocal_.point(line.o + s * line.d); };
  const Vec3d a = at(sEnter), b = at(sExit);
  const Vec3d hair = kPointRounding * max(max(abs(a), abs(b)), abs(mediumFromLocal_.t));
  const std::optional<Interval> range = params_.function->range({min(a, b) - hair, max(a, b) + hair});
  CHECK(range) << "bounds of a function without ranges";
  return {above(range->hi), below(range->lo)};
}

std::string ProceduralField::describe() const { return params_.function->describe(); }

}  // namespace pbrtmedia
