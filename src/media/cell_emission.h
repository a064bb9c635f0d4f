// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/transform.h"
#include "fields/affine_map.h"
#include "fields/super_voxels.h"
#include "media/emission_volume.h"

namespace pbrtmedia {

/// Points in super-voxels chosen by their strength, uniform within each. Keeps its own copy of the strengths,
/// 4 bytes a cell and 16 for each that emits, so that bounds may change while it is in use.
class CellEmission final : public EmissionVolume {
 public:
  /// Null when no cell has a strength. `emission`: sigma_a Le at strength 1.
  static std::unique_ptr<const EmissionVolume> over(const SuperVoxels& cells,
                                                    const std::function<float(const SuperVoxel&)>& strengthOf,
                                                    const Transform& worldFromLocal, Rgb emission);

  Sample sample(const std::array<double, 3>& u) const override;
  double pdf(Point3f p) const override;
  Bounds3f bounds() const override { return bounds_; }
  Rgb total() const override { return emission_ * static_cast<float>(total_); }

 private:
  CellEmission() = default;
  Bounds3d boxOf(const Vec3<std::int64_t>& cell) const;
  std::size_t indexOf(const Vec3<std::int64_t>& cell) const;

  SuperVoxelLattice lattice_;
  Transform worldFromLocal_;
  AffineMap localFromWorld_;
  Rgb emission_;
  Bounds3f bounds_;
  double total_ = 0;                     ///< integral of the strength over the volume
  std::vector<float> strengths_;         ///< of every cell, x fastest, without apron
  std::vector<std::uint64_t> emitters_;  ///< numbers of the cells that emit
  std::vector<double> cumulative_;       ///< their shares, added up; the last is 1
};

}  // namespace pbrtmedia
