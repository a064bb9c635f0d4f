// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/transform.h"
#include "fields/affine_map.h"
#include "fields/super_voxels.h"
#include "media/emission/emission_volume.h"

namespace pbrtmedia {

/// Points in super-voxels chosen by their weight, uniform within each. Keeps its own copy of the weights,
/// 4 bytes a cell and 16 for each that emits, so that bounds may change while it is in use.
class CellEmission final : public EmissionVolume {
 public:
  /// What a cell emits per volume, as one number, and what one that is not transparent shows of it at most.
  struct Weight {
    float emission = 0;  ///< relative to `emission` of `over`, less what the cell itself keeps back
    float power = 0;     ///< the same, closer to what is there: it may be 0 where points must be chosen
    float radiance = 0;  ///< relative to `radiance` of `over`
  };
  /// Null when no cell has a weight. `emission`: sigma_a Le, `radiance`: sigma_a Le / sigma_t, at weight 1.
  static std::unique_ptr<const EmissionVolume> over(const SuperVoxels& cells,
                                                    const std::function<Weight(const SuperVoxel&)>& weightOf,
                                                    const Transform& worldFromLocal, Rgb emission,
                                                    Rgb radiance);

  Point3f sample(const std::array<double, 3>& u) const override;
  double density(Point3f p) const override;
  double directionDensity(const Segment& line) const override;
  Bounds3f bounds() const override { return bounds_; }
  Rgb total() const override { return total_; }

 private:
  CellEmission() = default;
  Bounds3d boxOf(const Vec3<std::int64_t>& cell) const;

  SuperVoxelLattice lattice_;
  Transform worldFromLocal_;
  AffineMap localFromWorld_;
  Rgb total_;
  Bounds3f bounds_;
  double sum_ = 0;                       ///< integral of the weight over the volume
  std::vector<float> weights_;           ///< of every stored cell; 0 in the apron
  std::vector<std::uint64_t> emitters_;  ///< numbers of the cells that emit, x fastest, without apron
  std::vector<double> cumulative_;       ///< their shares, added up; the last is 1
};

}  // namespace pbrtmedia
