// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "base/transform.h"
#include "fields/super_voxels.h"
#include "media/control_density.h"
#include "media/density_kernel.h"
#include "media/emission/emission_distance.h"
#include "media/emission/emission_pattern.h"
#include "media/emission/emission_volume.h"

namespace pbrtmedia {

/// What a medium with a density field emits: the density times sigma_a Le, times a pattern if it has one.
/// Where to look for it is told by super-voxels: those of the density, or, where these do not come from data
/// or there is a pattern, others that know better.
class FieldEmission {
 public:
  FieldEmission() = default;  ///< nothing
  /// `emission`: sigma_a Le at density 1. `pattern` may be null. `density`: what it is the density of.
  FieldEmission(Rgb emission, Rgb sigmaT, std::shared_ptr<const EmissionPattern> pattern,
                const DensityKernel& density);

  bool isEmissive() const { return !emission_.isBlack(); }
  /// sigma_a Le at a point of world space where the density is known.
  Rgb at(Vec3d world, float density) const {
    const Rgb e = emission_ * density;
    return pattern_ && density > 0 ? e * pattern_->at(world) : e;
  }
  /// What a point emits over its extinction: the radiance of a body that is not transparent.
  Rgb sourceAt(Vec3d world) const;
  /// The same without the pattern, times `factor`.
  Rgb sourceOf(Rgb factor = Rgb(1.0f)) const;
  /// The super-voxels to walk: `bounds` are those of the density.
  const SuperVoxels& cells(const SuperVoxels& bounds) const { return cells_ ? *cells_ : bounds; }
  /// How much a cell of them emits, relative to `emission`.
  float strengthOf(const SuperVoxel& cell) const { return cells_ ? cell.upper : controlDensity(cell); }

  /// Of what a cell emits, the share that free flights find; distances chosen by a profile find the rest. A
  /// cell that one sees through is dense nowhere, so its profile is good; in one of many mean free paths
  /// light comes from the first of them behind the true surface, of which the profile knows nothing, and a
  /// flight that ends there always is.
  double flightShare(const SuperVoxel& cell) const { return flightShareAt(densityOf(cell)); }
  double flightShareAt(double density) const {
    constexpr double kThin = 1, kThick = 4;  // optical depths of a cell
    const double depth = static_cast<double>(sigmaT_.max()) * density * cellLength_;
    if (depth <= kThin) return 0;
    const double x = std::clamp((depth - kThin) / (kThick - kThin), 0.0, 1.0);
    return x * x * (3 - 2 * x);
  }
  /// The same at `s` of a line (over `cells`).
  double flightShareAt(const ClippedLine& line, double s) const;
  /// Adds what the intervals of a line (over `cells`) emit, less the share that flights find if
  /// there are such; a distance comes with what it has to find there as its tag. True: flights find some.
  bool addTo(EmissionSampler& sampler, const ClippedLine& line, bool hasFlights) const;
  /// For light sampling; null when no cell emits.
  std::unique_ptr<const EmissionVolume> volume(const SuperVoxels& bounds,
                                               const Transform& worldFromLocal) const;
  /// For --verbose; empty when nothing emits.
  std::string describe() const;
  std::size_t bytes() const { return (cells_ ? cells_->bytes() : 0) + (pattern_ ? pattern_->bytes() : 0); }

 private:
  /// The edge of a cube of a cell's volume, in world space.
  static double lengthOf(Vec3d cellSize, const Transform& worldFromLocal);
  /// A control of the density.
  double densityOf(const SuperVoxel& cell) const {
    return static_cast<double>(cells_ ? cell.mean : controlDensity(cell));
  }

  SuperVoxels patterned(const SuperVoxels& bounds, const DensityKernel& densities) const;

  Rgb emission_, sigmaT_;
  double cellLength_ = 0;
  std::shared_ptr<const EmissionPattern> pattern_;
  /// upper: strength; lower: with a pattern, an estimate of what it is on the average, at most `upper`; mean:
  /// control of the density.
  std::optional<SuperVoxels> cells_;
};

}  // namespace pbrtmedia
