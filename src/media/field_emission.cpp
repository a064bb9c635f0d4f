// SPDX-License-Identifier: BSD-2-Clause
#include "media/field_emission.h"

#include <sstream>

#include "media/cell_emission.h"

namespace pbrtmedia {

SuperVoxels FieldEmission::patterned(const SuperVoxels& bounds, const Transform& worldFromLocal) const {
  const SuperVoxelLattice& lattice = bounds.lattice();
  return SuperVoxels(lattice, [&](std::int64_t i, std::int64_t j, std::int64_t k) -> SuperVoxel {
    const SuperVoxel bound = bounds.at(i, j, k);
    if (!(bound.upper > 0)) return {0, 0, 0};
    const Vec3d size = lattice.cellSize;
    std::array<Vec3d, 8> corners;
    for (std::size_t c = 0; c < 8; ++c) {
      const Vec3d at{static_cast<double>(i) + ((c & 1) != 0 ? 1 : 0),
                     static_cast<double>(j) + ((c & 2) != 0 ? 1 : 0),
                     static_cast<double>(k) + ((c & 4) != 0 ? 1 : 0)};
      const Vec3d local{at.x * size.x, at.y * size.y, at.z * size.z};
      corners[c] = worldFromLocal.point(min(max(local, lattice.box.min), lattice.box.max));
    }
    const float density = controlDensity(bound);
    return {density * pattern_->upperOver(corners), 0, density};
  });
}

std::unique_ptr<const EmissionVolume> FieldEmission::volume(const SuperVoxels& bounds,
                                                            const Transform& worldFromLocal) const {
  if (!isEmissive()) return nullptr;
  return CellEmission::over(
      cells(bounds), [this](const SuperVoxel& cell) { return strengthOf(cell); }, worldFromLocal, emission_);
}

std::string FieldEmission::describe() const {
  if (!isEmissive()) return "";
  std::ostringstream text;
  text << ", emits " << emission_ << " per length and density";
  if (pattern_) text << " times " << pattern_->describe();
  return text.str();
}

}  // namespace pbrtmedia
