// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/transform.h"
#include "base/vec.h"

namespace pbrtmedia {

using VoxelIndex = Vec3<std::int64_t>;

/// What becomes of voxels below 0, which are no densities.
enum class NegativeRule { Clamp, Error, Keep };

/// A float grid of OpenVDB in memory. Keeps OpenVDB's headers out of those who use it.
class VdbDensity {
 public:
  /// The grid itself (vdb_density_grid.h).
  struct Grid;
  explicit VdbDensity(std::unique_ptr<Grid> grid);
  VdbDensity(VdbDensity&&) noexcept;
  VdbDensity& operator=(VdbDensity&&) noexcept;
  ~VdbDensity();

  const std::string& name() const { return name_; }
  bool isLevelSet() const { return isLevelSet_; }
  std::uint64_t activeVoxels() const { return activeVoxels_; }
  /// Box of the active voxels, both ends included; (0, 0, 0) twice where there are none.
  VoxelIndex activeMin() const { return activeMin_; }
  VoxelIndex activeMax() const { return activeMax_; }
  float background() const { return background_; }
  const Transform& worldFromIndex() const { return worldFromIndex_; }

  struct Range {
    float min = 0, max = 0;
  };
  /// Smallest and largest value of all voxels and tiles, active or not, and the background.
  Range range() const;

  struct Negatives {
    std::uint64_t count = 0;  ///< voxels, those of tiles included
    VoxelIndex first;
    float firstValue = 0;
  };
  /// Looks at every value. Throws std::runtime_error naming a voxel that is NaN or infinite, or (rule Error)
  /// negative; under rule Clamp negative ones, the background among them, become 0.
  Negatives checkValues(NegativeRule rule);

  /// The values of the box lo..hi, both ends included, x fastest.
  std::vector<float> samples(VoxelIndex lo, VoxelIndex hi) const;

  const Grid& grid() const { return *grid_; }

 private:
  void readFacts();

  std::unique_ptr<Grid> grid_;
  std::string name_;
  bool isLevelSet_ = false;
  std::uint64_t activeVoxels_ = 0;
  VoxelIndex activeMin_, activeMax_;
  float background_ = 0;
  Transform worldFromIndex_;
};

}  // namespace pbrtmedia
