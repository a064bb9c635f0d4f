// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "base/transform.h"
#include "fields/super_voxels.h"
#include "media/control_density.h"
#include "media/emission_distance.h"
#include "media/emission_pattern.h"
#include "media/emission_volume.h"
#include "media/probed_density.h"

namespace pbrtmedia {

/// What a medium with a density field emits: the density times sigma_a Le, times a pattern if it has one.
/// Where to look for it is told by super-voxels: those of the density, or, where these do not come from data
/// or there is a pattern, others that know better.
class FieldEmission {
 public:
  FieldEmission() = default;  ///< nothing
  /// `emission`: sigma_a Le at density 1. `pattern` may be null. `bounds`: of the field's density.
  template <class Field>
  FieldEmission(Rgb emission, std::shared_ptr<const EmissionPattern> pattern, const Field& field,
                const SuperVoxels& bounds)
      : emission_(emission), pattern_(std::move(pattern)) {
    if (!isEmissive()) return;
    if constexpr (!Field::kProvenBounds) {
      cells_ = probedDensity(bounds.lattice(), [&](Vec3d p) { return field.uncutDensity(p); });
    }
    if (pattern_) cells_ = patterned(cells_ ? *cells_ : bounds, field.worldFromLocal());
  }

  bool isEmissive() const { return !emission_.isBlack(); }
  /// sigma_a Le at a point of world space where the density is known.
  Rgb at(Vec3d world, float density) const {
    const Rgb e = emission_ * density;
    return pattern_ && density > 0 ? e * pattern_->at(world) : e;
  }
  /// The super-voxels to walk: `bounds` are those of the density.
  const SuperVoxels& cells(const SuperVoxels& bounds) const { return cells_ ? *cells_ : bounds; }
  /// How much a cell of them emits, relative to `emission`.
  float strengthOf(const SuperVoxel& cell) const { return cells_ ? cell.upper : controlDensity(cell); }

  /// Adds the intervals of a line (FieldLine over `cells`) to a profile.
  template <class Line, class Profile>
  void addTo(Profile& profile, const Line& line, Rgb sigmaT) const {
    line.walk([&](double sEnter, double sExit, const SuperVoxel& cell) {
      if (!(cell.upper > 0)) return true;
      const double strength = strengthOf(cell), density = cells_ ? cell.mean : controlDensity(cell);
      const auto times = [](Rgb c, double x) -> EmissionProfile::Channels {
        return {c.r * x, c.g * x, c.b * x};
      };
      profile.add(sEnter, sExit, times(emission_, strength), times(sigmaT, density));
      return true;
    });
  }
  /// For light sampling; null when no cell emits.
  std::unique_ptr<const EmissionVolume> volume(const SuperVoxels& bounds,
                                               const Transform& worldFromLocal) const;
  /// For --verbose; empty when nothing emits.
  std::string describe() const;
  std::size_t bytes() const { return (cells_ ? cells_->bytes() : 0) + (pattern_ ? pattern_->bytes() : 0); }

 private:
  Rgb emission_;
  std::shared_ptr<const EmissionPattern> pattern_;
  SuperVoxels patterned(const SuperVoxels& bounds, const Transform& worldFromLocal) const;

  /// upper: strength; mean: control of the density.
  std::optional<SuperVoxels> cells_;
};

}  // namespace pbrtmedia
