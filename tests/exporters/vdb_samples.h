// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/vec.h"

// Small .vdb files of every kind that has broken a converter, made when the tests run.
namespace pbrtmedia::test {

enum class VdbKind {
  TilesOnly,       ///< active tiles of 8^3 and 128^3 voxels, no leaf
  NegativeOrigin,  ///< [-66, -21, -90] .. [59, 64, 63], both ends active
  Placed,          ///< rotated, voxels not uniform, sheared
  Empty,           ///< no active voxel
  OneVoxel,        ///< (3, -4, 5)
  Half,            ///< stored with 16 bits
  Double,
  Negative,    ///< some voxels and one tile below 0
  Background,  ///< 0.25
  Inactive,    ///< values beside active ones that are not active themselves
  LevelSet,
  SphereLevelSet,  ///< radius 1 around (2, 0, 0), voxels of 0.1
  NotANumber,      ///< at (1, 2, 3)
  NotFinite,       ///< NaN at (1, 2, 3), infinities in a tile of 512 voxels from (40, 0, 0)
  Frustum
};

/// Writes a file of one grid called "density".
void writeVdb(const std::filesystem::path& file, VdbKind kind);
/// Grids called "density" (Placed), "", "density" again (OneVoxel), "with \"quotes\"", "temperature", and a
/// grid of vectors, "v".
void writeVdbOfManyGrids(const std::filesystem::path& file);
/// What a simulation of fire writes: "temperature" (`hottest` in the upper half of the box, voxels of 0.2),
/// "density" (1 in 20^3 voxels of 0.1 around the origin), "heat" (0.5 in the lower half), "vel" (vectors) and
/// "mask" (bools).
void writeFireVdb(const std::filesystem::path& file, float hottest);
/// A file without the table of offsets, as a stream writes it.
void writeVdbStream(const std::filesystem::path& file, VdbKind kind);

/// What OpenVDB's own trilinear sampler finds in grid number `grid` of a file at points of world space.
std::vector<double> sampledByOpenVdb(const std::filesystem::path& file, int grid,
                                     const std::vector<Vec3d>& world);

}  // namespace pbrtmedia::test
