// SPDX-License-Identifier: BSD-2-Clause
#pragma once

namespace pbrtmedia {

/// Bounds of a density over one cell of a super-voxel grid, faces included.
struct SuperVoxel {
  float upper = 0;  ///< density <= upper everywhere in the cell; 0: the cell is empty
  float lower = 0;  ///< density >= lower everywhere in the cell
  /// Average density over the part of the cell that the field fills; kUnknownMean where nobody computed it.
  float mean = kUnknownMean;

  static constexpr float kUnknownMean = -1;
  constexpr bool hasMean() const { return mean >= 0; }
  constexpr bool operator==(const SuperVoxel&) const = default;
};

}  // namespace pbrtmedia
