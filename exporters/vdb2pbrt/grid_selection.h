// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fields/grid_choice.h"

namespace pbrtmedia {

/// Called with one line for the user.
using Notice = std::function<void(const std::string&)>;

/// Which grids of a file were asked for, each by name, number or unique beginning.
struct GridWishes {
  std::vector<std::string> densities{};  ///< empty: the only density
  bool allDensities = false;  ///< every float grid whose name does not tell that it is something else
  std::string temperature{}, factor{};  ///< "": none
};

/// Numbers of grids.
struct GridSelection {
  std::vector<std::size_t> densities;
  std::optional<std::size_t> temperature, factor;
};

/// Throws SceneError or std::runtime_error with a list of the grids where a wish cannot be met. Without a
/// name float grids that are called temperatures, flames and the like (vdb2pbrt/grid_role.h) are no
/// densities.
GridSelection selectGrids(std::span<const GridCandidate> grids, const GridWishes& wishes);

/// Tells which float grids were taken for densities, if that was not said by name, and which grids are left
/// out, with what would make use of them.
void noticeSelection(std::span<const GridCandidate> grids, const GridWishes& wishes,
                     const GridSelection& selection, const Notice& notice);

}  // namespace pbrtmedia
