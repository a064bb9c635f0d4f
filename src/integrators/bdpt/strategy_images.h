// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "film/side_images.h"

namespace pbrtmedia {

/// What an image for each strategy shows, if there are such images.
enum class StrategyView {
  None,
  Unweighted,  ///< the strategy as if it were the only one; light that it does not count is left out
  Weighted     ///< what it adds to the image
};

/// Scatterings of the longest paths whose strategies have images, as in PBRT-v3: there are many of them.
inline constexpr int kMostShownDepth = 5;

/// An image for each strategy of `bdpt` with paths of up to so many scatterings, named as PBRT-v3 does:
/// "bdpt_d02_s01_t03.exr" is of paths with two scatterings, one vertex from the light's end and three from
/// the camera's, both ends included. By depth, then s.
std::vector<SideImage> strategyImages(int maxDepth);

/// Number of that of s vertices from the light's end and t from the camera's, t at least 1, among them.
constexpr std::size_t strategyImage(std::size_t s, std::size_t t) {
  const std::size_t depth = s + t - 2;
  // One image at depth 0, as light that is seen directly is looked for by the camera alone, then depth + 2.
  return depth == 0 ? 0 : 1 + (depth - 1) * (depth + 4) / 2 + s;
}

}  // namespace pbrtmedia
