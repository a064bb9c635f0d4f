// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vdb2pbrt/conversion.h"

namespace pbrtmedia {

/// The grids of a file that were asked for, in memory and checked.
struct Volume {
  std::vector<VdbDensity> grids;  ///< densities first
  std::size_t densityCount = 0;
  std::optional<std::size_t> temperature, factor;  ///< numbers in `grids`
  std::string creator;                             ///< the program that wrote the file, if it tells

  std::span<const VdbDensity> densities() const { return std::span(grids).first(densityCount); }
  bool glows() const { return temperature || factor; }
  /// In world space; empty without active voxels.
  Bounds3d box() const;
};

/// Reads and checks the chosen grids. Throws std::runtime_error naming the file.
Volume readVolume(const std::filesystem::path& input, const ConversionOptions& options, const Notice& notice,
                  const Progress& progress);

}  // namespace pbrtmedia
