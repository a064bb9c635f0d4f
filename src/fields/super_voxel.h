// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <concepts>

namespace pbrtmedia {

/// Bounds of a density over a part of space, borders included, in the precision of the density: the
/// renderer's are `SuperVoxel`, those of lines whose density is a double are too.
template <std::floating_point Real>
struct DensityBounds {
  Real upper = 0;  ///< density <= upper everywhere; 0: empty
  Real lower = 0;  ///< density >= lower everywhere
  /// Average density over the part that the field fills; kUnknownMean where nobody computed it.
  Real mean = kUnknownMean;

  static constexpr Real kUnknownMean = -1;
  constexpr bool hasMean() const { return mean >= 0; }
  constexpr bool operator==(const DensityBounds&) const = default;
};

/// Those of one cell of a super-voxel grid.
using SuperVoxel = DensityBounds<float>;

}  // namespace pbrtmedia
