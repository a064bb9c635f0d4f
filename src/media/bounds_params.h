// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "fields/super_voxels.h"

namespace pbrtmedia {

/// Where the bounds of a density field come from. Numbers that bound are extinctions, 1/world length, of the
/// channel with the largest sigma_t, as the majorant of Misso et al. 2023 is; the medium divides by that
/// sigma_t.
struct BoundsParams {
  enum class Source {
    Exact,       ///< from the data, proven
    Constant,    ///< `majorant`, by somebody's word: densities above it are used as they are, and counted
    Progressive  ///< learned while rendering (LearnedBounds)
  };
  Source source = Source::Exact;
  WantedCells cells;                             ///< super-voxels per axis
  float majorant = 0;                            ///< Constant only: >= 0
  float initialExtinction = 0.01f;               ///< Progressive only, as below: before the first pass, > 0
  float epsilon = 0.01f;                         ///< added to an extinction that is proposed as a bound, > 0
  float slack = 0;                               ///< LearnedBounds::Params::slack, >= 0
  int warmUpPasses = 4;                          ///< LearnedBounds::Params::warmUpPasses, >= 0
  std::optional<std::uint64_t> warmUpLookups{};  ///< LearnedBounds::Params::warmUpLookups
};

}  // namespace pbrtmedia
