// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <string>

#include "base/vec.h"
#include "fields/canonical_function.h"

namespace pbrtmedia {

/// A ray o + t d in the world space of a volume file.
struct VolumeRay {
  Vec3d o, d;  ///< d: any length but 0; x of the function is a length all the same
};

/// The density of an .nvdb file (`grid`: its name, number or unique beginning; "": the only one) along a ray,
/// from where it enters the box of the active voxels to where it leaves it. Between two planes of voxel
/// centres a trilinear density is a cubic of the distance: the one through four look-ups in single precision,
/// whose integral is exact. Throws std::runtime_error when the file or the grid cannot be used, and when the
/// ray misses the volume or meets no density.
CanonicalFunction functionAlong(const std::filesystem::path& file, const std::string& grid,
                                const VolumeRay& ray);

}  // namespace pbrtmedia
