// SPDX-License-Identifier: BSD-2-Clause
#include "media/emission/field_emission.h"

#include <cmath>
#include <sstream>

#include "base/hash.h"
#include "base/rng.h"
#include "media/emission/cell_emission.h"
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
  if (pattern_) cells_ = patterned(cells_ ? *cells_ : bounds, density);
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
    const double density = densityOf(cell), rest = hasFlights ? 1 - flightShareAt(density) : 1;
    flies |= rest < 1;
    sampler.add(sEnter, sExit, times(emission_, strengthOf(cell) * rest), times(sigmaT_, density), rest);
    return true;
  });
  return flies;
}

SuperVoxels FieldEmission::patterned(const SuperVoxels& bounds, const DensityKernel& densities) const {
  // A bound on the pattern may be many times what is there: what points emit counts, and a share of the bound
  // where they miss the brightest.
  constexpr float kLeastShare = 0.1f;
  constexpr int kProbes = 2;  // along each axis of a cell, jittered
  const SuperVoxelLattice& lattice = bounds.lattice();
  const Transform& worldFromLocal = densities.worldFromLocal();
  const float emitted = emission_.r + emission_.g + emission_.b;
  const Rgb share = emission_ / emitted;
  return SuperVoxels(lattice, [&](std::int64_t i, std::int64_t j, std::int64_t k) -> SuperVoxel {
    const SuperVoxel bound = bounds.at(i, j, k);
    if (!(bound.upper > 0)) return {0, 0, 0};
    const auto within = [&](Vec3d inside) {
      const Vec3d at = Vec3d(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)) + inside;
      const Vec3d size = lattice.cellSize, local{at.x * size.x, at.y * size.y, at.z * size.z};
      return min(max(local, lattice.box.min), lattice.box.max);
    };
    std::array<Vec3d, 8> corners;
    for (std::size_t c = 0; c < 8; ++c) {
      corners[c] = worldFromLocal.point(
          within(Vec3d((c & 1) != 0 ? 1 : 0, (c & 2) != 0 ? 1 : 0, (c & 4) != 0 ? 1 : 0)));
    }
    double sum = 0;
    Rng rng(hashCombine(static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(j),
                        static_cast<std::uint64_t>(k)));
    for (int p = 0; p < kProbes * kProbes * kProbes; ++p) {
      const int along[] = {p % kProbes, p / kProbes % kProbes, p / (kProbes * kProbes)};
      const double x = along[0] + rng.uniformDouble(), y = along[1] + rng.uniformDouble(),
                   z = along[2] + rng.uniformDouble();
      const Vec3d probe = within(Vec3d(x, y, z) / kProbes);
      const float density = densities.uncutDensity(probe);
      if (!(density > 0)) continue;
      const Rgb found = share * pattern_->at(worldFromLocal.point(probe));
      sum += static_cast<double>(density * (found.r + found.g + found.b));
    }
    const float control = controlDensity(bound);
    const float most = control * pattern_->upperOver(corners),
                mean = static_cast<float>(sum / (kProbes * kProbes * kProbes));
    if (!(most > 0) || !std::isfinite(mean)) return {most, most, control};
    return {std::max(mean, kLeastShare * most), mean, control};
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
    const double emitting = pattern_ ? static_cast<double>(cell.lower) : strength;
    return {static_cast<float>(strength * escaping), static_cast<float>(emitting * escaping),
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
