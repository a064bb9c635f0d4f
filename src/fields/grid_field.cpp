// SPDX-License-Identifier: BSD-2-Clause
#include "fields/grid_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/diagnostics.h"
#include "fields/field_box.h"
#include "fields/grid_bounds.h"

namespace pbrtmedia {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw SceneError(SourceLocation{}, "grid field: " + what);
}

void checkShape(const GridField::Params& p) {
  if (p.nx < 1 || p.ny < 1 || p.nz < 1) {
    refuse("\"nx\", \"ny\", \"nz\" must be at least 1; found " + std::to_string(p.nx) + ", " +
           std::to_string(p.ny) + ", " + std::to_string(p.nz));
  }
  // The product of three int fits an unsigned 128-bit number; of two a 64-bit one.
  const auto slice = static_cast<std::uint64_t>(p.nx) * static_cast<std::uint64_t>(p.ny);
  const auto nz = static_cast<std::uint64_t>(p.nz);
  const bool fits = slice <= std::numeric_limits<std::uint64_t>::max() / nz;
  if (!fits || slice * nz != p.density.size()) {
    refuse("\"density\" must hold nx * ny * nz = " + std::to_string(p.nx) + " * " + std::to_string(p.ny) +
           " * " + std::to_string(p.nz) + (fits ? " = " + std::to_string(slice * nz) : "") +
           " values; found " + std::to_string(p.density.size()));
  }
}

void checkValues(const GridField::Params& p) {
  const auto bad = std::find_if(p.density.begin(), p.density.end(),
                                [](float v) { return !(v >= 0) || !std::isfinite(v); });
  if (bad == p.density.end()) return;
  const auto index = static_cast<std::uint64_t>(bad - p.density.begin());
  const auto nx = static_cast<std::uint64_t>(p.nx), ny = static_cast<std::uint64_t>(p.ny);
  std::ostringstream message;
  message << "\"density\" must be finite and >= 0; found " << *bad << " at voxel (" << index % nx << ", "
          << index / nx % ny << ", " << index / nx / ny << "), value number " << index << " counted from 0";
  refuse(message.str());
}

/// Checks first: what follows must not read a grid that is not there.
const GridField::Params& checked(const GridField::Params& params) {
  checkShape(params);
  checkValues(params);
  return params;
}

}  // namespace

GridField::GridField(const Params& params, const Transform& worldFromMedium)
    : n_{params.nx, params.ny, params.nz},
      samples_(checked(params).nx, params.ny, params.nz, params.density, params.border, params.precision,
               params.layout) {
  const Transform worldFromCube = worldFromUnitCube(params.p0, params.p1, worldFromMedium, kTypeName);
  // Unit cube -> [1/2, n + 1/2].
  worldFromLocal_ = worldFromCube * Transform::scale(1.0 / n_[0], 1.0 / n_[1], 1.0 / n_[2]) *
                    Transform::translate({-0.5, -0.5, -0.5});
  localFromWorld_ = AffineMap(worldFromLocal_.inverseMatrix());
}

float GridField::densityAt(Point3f world) const {
  const Vec3d p = localFromWorld_.point(Vec3d(world));
  return localBox().contains(p) ? density(p) : 0;
}

Bounds3d GridField::localBox() const { return {{0.5, 0.5, 0.5}, {n_[0] + 0.5, n_[1] + 0.5, n_[2] + 0.5}}; }

SuperVoxelLattice GridField::lattice(const WantedCells& wanted) const {
  SuperVoxelLattice lattice{.box = localBox()};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t gaps = n_[a] + std::int64_t{1};
    const std::int64_t size = wanted ? gapsPerCell(gaps, (*wanted)[a]) : 1 << kDefaultSuperVoxelPower;
    lattice.shape.count[a] = (gaps + size - 1) / size;
    lattice.cellSize[a] = static_cast<double>(size);
  }
  return lattice;
}

SuperVoxels GridField::superVoxels(const SuperVoxelLattice& lattice) const {
  return gridBounds(samples_, n_[0], n_[1], n_[2], Vec3<std::int64_t>(lattice.cellSize));
}

SuperVoxels GridField::superVoxels(int power) const {
  if (power < 0 || power > kMaxSuperVoxelPower) {
    refuse("a super-voxel spans 2^p samples, p from 0 to " + std::to_string(kMaxSuperVoxelPower) +
           "; found p = " + std::to_string(power));
  }
  const std::int64_t size = std::int64_t{1} << power;
  return gridBounds(samples_, n_[0], n_[1], n_[2], {size, size, size});
}

std::string GridField::describe() const {
  std::ostringstream text;
  text << "grid " << n_[0] << " x " << n_[1] << " x " << n_[2];
  if (samples_.view().halves) text << ", half precision";
  if (isBricked()) text << ", bricked";
  return text.str();
}

}  // namespace pbrtmedia
