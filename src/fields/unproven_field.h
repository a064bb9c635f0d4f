// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "fields/explore_bounds.h"
#include "fields/lattice_walk.h"
#include "fields/learned_bounds.h"

namespace pbrtmedia {

/// A field whose bounds do not come from its data. Either they are somebody's word and stay as they are: the
/// density is the field's, wherever that is above its bound. Or they are learned (LearnedBounds): then the
/// density is the field's cut to the bounds in force. Not piecewise cubic, whatever the field is.
template <class Field>
class UnprovenField {
 public:
  static constexpr std::string_view kTypeName = Field::kTypeName;
  static constexpr bool kProvenBounds = false;

  /// Bounds that stay.
  UnprovenField(Field field, SuperVoxels bounds) : field_(std::move(field)), given_(std::move(bounds)) {}
  /// Bounds that are learned, one for each cell of `cells`.
  UnprovenField(Field field, const SuperVoxelLattice& cells, const LearnedBounds::Params& params)
      : field_(std::move(field)), learned_(std::make_unique<LearnedBounds>(cells, params)) {}

  float density(Vec3d p) const {
    const float density = field_.density(p);
    return learned_ ? learned_->bounded(p, density) : density;
  }
  void densities(const LocalLine& line, std::span<const double> s, std::span<float> out) const {
    if constexpr (requires { field_.densities(line, s, out); }) {
      field_.densities(line, s, out);
    } else {
      for (std::size_t i = 0; i < s.size(); ++i) out[i] = field_.density(line.o + s[i] * line.d);
    }
    if (!learned_) return;
    for (std::size_t i = 0; i < s.size(); ++i) out[i] = learned_->bounded(line.o + s[i] * line.d, out[i]);
  }

  /// The field's own density, not cut; nothing is learned of it.
  float uncutDensity(Vec3d p) const { return field_.density(p); }

  /// Before rendering: explores blocks of learned bounds (exploreBounds). Answers the look-ups made.
  std::uint64_t explore(const Exploration& plan, std::size_t first, std::size_t last,
                        std::uint64_t seed) const {
    if (!learned_) return 0;
    return exploreBounds(*learned_, plan, first, last, seed, [&](Vec3d p) { return field_.density(p); });
  }

  decltype(auto) localFromWorld() const { return field_.localFromWorld(); }
  decltype(auto) worldFromLocal() const { return field_.worldFromLocal(); }
  const SuperVoxels& inForce() const { return learned_ ? learned_->inForce() : *given_; }
  /// Null when the bounds are given.
  LearnedBounds* learned() const { return learned_.get(); }
  std::string describe() const {
    return field_.describe() + (learned_ ? ", bounds learned" : ", bounds given");
  }
  std::string complaint() const {
    if constexpr (requires { field_.complaint(); }) {
      return field_.complaint();
    } else {
      return {};
    }
  }
  std::size_t bytes() const { return field_.bytes() + (learned_ ? learned_->bytesOfProposals() : 0); }

 private:
  Field field_;
  std::optional<SuperVoxels> given_;
  std::unique_ptr<LearnedBounds> learned_;
};

}  // namespace pbrtmedia
