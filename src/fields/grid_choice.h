// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace pbrtmedia {

/// One grid of a volume file, as far as choosing among them goes.
struct GridCandidate {
  std::string name;
  std::string description;  ///< type, class, extent: what a list shows after the name
  bool isDensity = false;   ///< holds one real number per voxel
};

/// The number of the grid that `wanted` names: its exact name (the first of several), else its number counted
/// from 0 (also "name[1]": the second grid of that name), else the only name that begins with it. "" asks for
/// the only density, or the one called "density". Throws SceneError (location unknown) that lists all grids
/// when nothing or more than one fits; whether the grid found is a density is for the caller to check.
std::size_t chooseGrid(std::span<const GridCandidate> grids, std::string_view wanted);

/// The list of all grids for a message: `0: "density" (float, fog volume, …)`, one per line, indented.
std::string listGrids(std::span<const GridCandidate> grids);

}  // namespace pbrtmedia
