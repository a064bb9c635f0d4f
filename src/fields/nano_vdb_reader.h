// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/transform.h"
#include "fields/brick_tree.h"
#include "fields/nano_vdb_file.h"

namespace pbrtmedia {

/// A grid of an .nvdb file, ready for look-ups.
struct NanoVdbGrid {
  std::string name, type, gridClass;
  bool hasActive = false;  ///< some voxel or tile is active
  /// Box of the active voxels in index space, both ends included; without any, box and tree mean nothing.
  Vec3<std::int64_t> activeMin, activeMax;
  Transform worldFromIndex;  ///< the file's own
  /// Values inside [activeMin - 2, activeMax + 2] at least, active or not.
  BrickTree tree;
  Vec3<std::int64_t> treeOrigin;  ///< index coordinates of the tree's sample (0, 0, 0)
};

/// Densities below 0 that were found, and count as 0.
struct NegativeDensities {
  std::size_t count = 0;  ///< voxels
  std::string first;      ///< where: "voxel (1, 2, 3)"
  float density = 0;      ///< that of the first
};

/// How values become densities: scale * value + offset.
struct DensityMap {
  float scale = 1;                         ///< >= 0, finite
  float offset = 0;                        ///< finite
  NegativeDensities* negatives = nullptr;  ///< takes negative ones; null: they are refused
};

/// Reads grid number `index` of the file, a float, double, Fp4, Fp8, Fp16 or FpN grid. Nothing of the file is
/// trusted: its checksum is compared (version 32.4; other versions compute it otherwise), and every offset is
/// checked before it is followed. Quantised values stay so in memory. Throws SceneError at the file: corrupt
/// data, values of another type, a density that is not finite or that is negative and has no taker, or
/// belongs to a level set (the voxel is named), a transform without inverse, an extent beyond what BrickTree
/// holds, a build without NanoVDB.
NanoVdbGrid readNanoVdbGrid(const NanoVdbFile& file, std::size_t index, const DensityMap& map);

}  // namespace pbrtmedia
