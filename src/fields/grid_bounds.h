// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "fields/grid_samples.h"
#include "fields/super_voxels.h"

namespace pbrtmedia {

/// A cell whose samples lie in [lower, upper] and have this mean: bounds with slack for the rounding of a
/// look-up, none where all samples are equal, as these are interpolated exactly.
SuperVoxel withRoundingSlack(float lower, float upper, double mean);

/// Bounds and mean of the interpolated density over cells of whole lattice gaps (`size` of them per axis),
/// from lattice plane 0 on. `nx`, ...: samples per axis without the apron; the field's box is [1/2, n + 1/2].
///
/// Bounds hold for look-ups, their rounding included. The mean is the exact average (up to its own rounding
/// to float) of the trilinear interpolant over the part of the cell inside the box; it lies within the bounds
/// and is 0 exactly where the upper one is.
SuperVoxels gridBounds(const GridSamples& samples, int nx, int ny, int nz, Vec3<std::int64_t> size);

}  // namespace pbrtmedia
