// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/param_list.h"

namespace pbrtmedia {

/// What the command line has to say about how a scene is built.
struct ConstructOptions {
  std::optional<std::filesystem::path> outfile{};    ///< overrides Film "filename"
  std::optional<std::array<float, 4>> cropWindow{};  ///< x0 x1 y0 y1; a Film "cropwindow" wins over it
  bool quick = false;                             ///< resolution / 4, one sample per pixel (random: as asked)
  std::optional<std::int64_t> samplesPerPixel{};  ///< overrides the sampler's
  std::uint64_t seed = 0;
  std::optional<std::vector<std::string>> layers{};  ///< overrides Film "layers"
  /// Replace those of every medium with a density field, or are added to them.
  ParamList mediumParams{};
};

}  // namespace pbrtmedia
