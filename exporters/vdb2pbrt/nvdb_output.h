// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <span>

#include "vdb2pbrt/vdb_density.h"

namespace pbrtmedia {

/// How values are stored: as floats, as codes of 16, 8 or 4 bits between the smallest and the largest value
/// of each 8^3 brick, or as codes of as few bits as a tolerance allows.
enum class NvdbPrecision { Float, Fp16, Fp8, Fp4, FpN };

struct NvdbOptions {
  NvdbPrecision precision = NvdbPrecision::Float;
  float tolerance = 0.01f;  ///< FpN: largest error of a value, > 0
  bool zip = false;
};

/// Writes the grids into one .nvdb file, with statistics of every node and full checksums, under a temporary
/// name that is then renamed. Index space, transformations, tiles, inactive values and backgrounds stay. The
/// same grids give the same bytes. Throws std::runtime_error.
void writeNvdb(const std::filesystem::path& path, std::span<const VdbDensity> grids,
               const NvdbOptions& options);

}  // namespace pbrtmedia
