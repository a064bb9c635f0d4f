// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pbrtmedia {

/// What is built for scenes that need it, and for no others.
enum class Part : std::size_t {
  Media,
  ChromaticMedia,      ///< whose extinction coefficients differ: three channels instead of one
  SuperVoxelGrids,     ///< bounds of density fields
  LearnedBounds,       ///< bounds that rise while rendering
  Textures,            ///< those that are not constant
  RayDifferentials,    ///< cameras whose rays know the footprint of a pixel
  LightDistributions,  ///< tables: of maps over directions, and of lights to choose from
  RayTrees,            ///< acceleration structures, one for each object of instances too
  SubsurfaceTables,
  PhotonMaps,
  Layers,        ///< planes of the film besides the colour
  FilmHalves,    ///< even and odd samples apart
  SplatBuffers,  ///< light that is found by paths from lights
  kCount
};
inline constexpr std::size_t kPartCount = static_cast<std::size_t>(Part::kCount);

/// How many of each, by Part.
struct BuiltParts {
  std::array<std::uint64_t, kPartCount> counts{};
  std::uint64_t operator[](Part part) const { return counts[static_cast<std::size_t>(part)]; }
  BuiltParts operator-(const BuiltParts& earlier) const;
};

/// As in statistics: "superVoxelGrids".
std::string_view nameOf(Part part);

/// To be called by what builds one. Thread-safe.
void countBuilt(Part part, std::uint64_t n = 1);
/// All that this process has built so far, what it has destroyed since included. Thread-safe.
BuiltParts builtParts();

}  // namespace pbrtmedia
