// SPDX-License-Identifier: BSD-2-Clause
#include "media/field_emission.h"

#include <cmath>
#include <sstream>

#include "media/cell_emission.h"
#include "media/probed_density.h"

namespace pbrtmedia {
namespace {

EmissionSampler::Channels times(Rgb c, double x) { return {c.r * x, c.g * x, c.b * x}; }

}  // namespace

FieldEmission::FieldEmission(Rgb emission, Rgb sigmaT, std::shared_ptr<const EmissionPattern> pattern,
                             const DensityKernel& density)
    : emission_(emission), sigmaT_(sigmaT), pattern_(std::move(pattern)) {
  if (!isEmissive()) return;
  const SuperVoxels& bounds = density.superVoxels();
  cellLength_ = lengthOf(bounds.cellSize(), density.worldFromLocal());
  if (!density.bounds().areProven()) {
    cells_ = probedDensity(bounds.lattice(), [&](Vec3d p) { return density.uncutDensity(p); });
  }
  if (pattern_) cells_ = patterned(cells_ ? *cells_ : bounds, density.worldFromLocal());
}

double FieldEmission::flightShareAt(const ClippedLine& line, double s) const {
  double share = 0;
  line.walkCells([&](double, double sExit, const SuperVoxel& cell) {
    share = cell.upper > 0 ? flightShare(cell) : 0;
    return sExit < s;
  });
  return share;
}

bool FieldEmission::addTo(EmissionSampler& sampler, const ClippedLine& line, bool hasFlights) const {
  bool flies = false;
  line.walkCells([&](double sEnter, double sExit, const SuperVoxel& cell) {
    if (!(cell.upper > 0)) return true;
    const double rest = hasFlights ? 1 - flightShare(cell) : 1;
    flies |= rest < 1;
    sampler.add(sEnter, sExit, times(emission_, strengthOf(cell) * rest), times(sigmaT_, densityOf(cell)),
                rest);
    return true;
  });
  return flies;
}

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

Rgb FieldEmission::sourceOf(Rgb factor) const {
  Rgb source;
  for (std::size_t c = 0; c < 3; ++c) {
    if (emission_[c] > 0) source[c] = emission_[c] * factor[c] / sigmaT_[c];
  }
  return source;
}

Rgb FieldEmission::sourceAt(Vec3d world) const {
  return sourceOf(pattern_ ? pattern_->at(world) : Rgb(1.0f));
}

double FieldEmission::lengthOf(Vec3d cellSize, const Transform& worldFromLocal) {
  return std::cbrt(cellSize.x * cellSize.y * cellSize.z * std::abs(worldFromLocal.matrix().determinant3()));
}

std::unique_ptr<const EmissionVolume> FieldEmission::volume(const SuperVoxels& bounds,
                                                            const Transform& worldFromLocal) const {
  if (!isEmissive()) return nullptr;
  const float emitted = emission_.r + emission_.g + emission_.b;
  const auto weightOf = [&](const SuperVoxel& cell) -> CellEmission::Weight {
    const double strength = static_cast<double>(strengthOf(cell)), density = densityOf(cell);
    double escaping = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      // The mean chord of a cube is two thirds of its edge.
      escaping += static_cast<double>(emission_[c] / emitted) *
                  escapingShare(static_cast<double>(sigmaT_[c]) * density * cellLength_ * (2.0 / 3));
    }
    return {static_cast<float>(strength * escaping),
            density > 0 ? static_cast<float>(strength / density) : 0.0f};
  };
  return CellEmission::over(cells(bounds), weightOf, worldFromLocal, emission_, sourceOf(Rgb(1.0f)));
}

std::string FieldEmission::describe() const {
  if (!isEmissive()) return "";
  std::ostringstream text;
  text << ", emits " << emission_ << " per length and density";
  if (pattern_) text << " times " << pattern_->describe();
  return text.str();
}

}  // namespace pbrtmedia
