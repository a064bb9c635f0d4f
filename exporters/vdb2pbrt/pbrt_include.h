// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/transform.h"
#include "base/vec.h"
#include "vdb2pbrt/vdb_density.h"

namespace pbrtmedia {

/// What the include says beside the grids.
struct IncludeOptions {
  Vec3d sigmaA{0, 0, 0}, sigmaS{1, 1, 1};  ///< per unit of world length at density 1, >= 0
  double scale = 1;
};

/// What glows: the grids beside the densities, each with what the .nvdb file calls it.
struct IncludeEmission {
  const VdbDensity* temperature = nullptr;  ///< black bodies of (value - offset) * scale kelvin; else `le`
  const VdbDensity* factor = nullptr;       ///< how much of that, from place to place
  std::string temperatureGrid, factorGrid;
  double temperatureScale = 1, temperatureOffset = 0;
  Vec3d le{1, 1, 1};  ///< radiance without temperatures
  double leScale = 1;
  bool isThere() const { return temperature != nullptr || factor != nullptr; }
};

/// A grid in the text: its facts, and how it is called.
struct IncludeGrid {
  const VdbDensity* density = nullptr;
  std::string medium;  ///< name of the medium
  std::string grid;    ///< how the .nvdb file is asked for it
};

/// The text of a .pbrt include: for each grid a medium of type "nanovdb" and a box without material around
/// it; several media add up where they overlap. `nvdb`: the file's name as the text gives it. `source`: for
/// the comment at the top.
std::string nvdbInclude(std::span<const IncludeGrid> grids, const IncludeEmission& emission,
                        const std::string& nvdb, const std::string& source, const IncludeOptions& options);

/// The same with the samples themselves, as PBRT-v3's "heterogeneous": one sample of the background is added
/// all around, so that the density fades exactly as the sparse one. What glows is interpolated at the samples
/// of each density. Throws std::runtime_error when that is more than kMaxDenseSamples.
std::string denseInclude(std::span<const IncludeGrid> grids, const IncludeEmission& emission,
                         const std::string& source, const IncludeOptions& options);
inline constexpr std::int64_t kMaxDenseSamples = std::int64_t{1} << 28;  ///< 1 GiB as floats in PBRT

/// Names for the media of the grids: the grid's own name, the file's stem where it has none or one that a
/// scene file cannot spell, numbered where that is not unique.
std::vector<std::string> mediumNames(std::span<const VdbDensity> grids, const std::string& stem);
/// How the grids are asked for in a file of exactly these: by name, or by number where a name cannot.
std::vector<std::string> gridSelectors(std::span<const VdbDensity> grids);

/// A string of a scene file: in quotes, with escapes.
std::string quoted(const std::string& text);
/// Text in a comment of a scene file: on one line.
std::string inComment(const std::string& text);
/// The fewest digits that read back to the same number.
void putNumber(std::string& out, double number);
/// Three numbers with blanks between.
void putVector(std::string& out, Vec3d v);

}  // namespace pbrtmedia
