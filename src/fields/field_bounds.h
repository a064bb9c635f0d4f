// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "fields/learned_bounds.h"
#include "fields/super_voxels.h"

namespace pbrtmedia {

/// The super-voxel bounds of a density field, and whose word they are.
///   - Proven: they follow from the data.
///   - Given: somebody's word, which stays. The density is the field's, wherever that is above its bound.
///   - Learned (LearnedBounds): the density is the field's cut to the bounds in force.
/// Movable; what is borrowed from it stays where it is only while it is not moved.
class FieldBounds {
 public:
  static FieldBounds proven(SuperVoxels bounds) { return FieldBounds(std::move(bounds), true); }
  static FieldBounds given(SuperVoxels bounds) { return FieldBounds(std::move(bounds), false); }
  /// One bound for each cell of `cells`.
  static FieldBounds learned(const SuperVoxelLattice& cells, const LearnedBounds::Params& params) {
    return FieldBounds(std::make_unique<LearnedBounds>(cells, params));
  }

  const SuperVoxels& inForce() const { return learned_ ? learned_->inForce() : *fixed_; }
  bool areProven() const { return areProven_; }
  /// Null unless they are learned.
  LearnedBounds* learned() const { return learned_.get(); }
  std::size_t bytes() const { return inForce().bytes() + (learned_ ? learned_->bytesOfProposals() : 0); }

 private:
  FieldBounds(SuperVoxels bounds, bool areProven) : fixed_(std::move(bounds)), areProven_(areProven) {}
  explicit FieldBounds(std::unique_ptr<LearnedBounds> learned) : learned_(std::move(learned)) {}

  std::optional<SuperVoxels> fixed_;
  std::unique_ptr<LearnedBounds> learned_;
  bool areProven_ = false;
};

}  // namespace pbrtmedia
