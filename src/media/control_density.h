// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>

#include "fields/super_voxel.h"

namespace pbrtmedia {

/// One density for a whole super-voxel, to steer sampling: its mean where known, else its bound. Positive
/// where the bound is.
inline float controlDensity(const SuperVoxel& bound) {
  constexpr float kLeastShare = 1e-3f;  // of the bound: a mean may round to 0
  return bound.hasMean() ? std::max(bound.mean, kLeastShare * bound.upper) : bound.upper;
}

}  // namespace pbrtmedia
