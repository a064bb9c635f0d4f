// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "base/transform.h"
#include "base/vec.h"

namespace pbrtmedia {

using VoxelIndex = Vec3<std::int64_t>;

/// What becomes of voxels below 0, which are no densities.
enum class NegativeRule { Clamp, Error, Keep };
/// What becomes of voxels that are NaN or infinite.
enum class NanRule { Error, Zero };

/// A float grid of OpenVDB in memory, a density or what belongs to one. Keeps OpenVDB's headers out of those
/// who use it.
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

  /// Voxels of a kind, those of tiles included.
  struct Finding {
    std::uint64_t count = 0;
    VoxelIndex first;  ///< the first in the order of storage: tiles, then leaves
    float firstValue = 0;
  };
  struct Findings {
    Finding notFinite, negative;
  };
  /// Looks at every value. Under rule Zero NaN and infinities, under rule Clamp negative numbers become 0,
  /// the background among them. Throws std::runtime_error that counts them and names the first one under the
  /// rules Error.
  Findings checkValues(NegativeRule negative, NanRule nan);

  /// Makes a fog volume of a level set: 1 inside, falling to 0 over the inner half of its band, 0 outside.
  /// Throws std::runtime_error when the background, the width of the band, is not above 0.
  void makeFog();

  /// The value that the share `q` of the active voxels above 0 does not exceed, to 1/4096 of the largest; 0
  /// where there are none.
  float quantile(double q) const;

  /// Integral of the value, interpolated trilinearly, over a line in world space: `steps` midpoints. Not
  /// finite or negative values count as 0.
  double integral(Vec3d from, Vec3d to, int steps) const;

  /// Of the active voxels above `threshold`, the share that lies where `density` is 0 throughout; at most
  /// some 10^5 of them, evenly spaced, are looked at.
  double shareOutside(const VdbDensity& density, float threshold) const;

  /// The values of the box lo..hi, both ends included, x fastest.
  std::vector<float> samples(VoxelIndex lo, VoxelIndex hi) const;
  /// The values at the voxels lo..hi of another index space, interpolated trilinearly.
  std::vector<float> samplesAt(const Transform& worldFromOther, VoxelIndex lo, VoxelIndex hi) const;
  /// World space box of the active voxels' centres grown by one voxel; empty where there are none.
  Bounds3d worldBox() const;

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
