// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "scene/description.h"
#include "scene/variables.h"

namespace pbrtmedia {

struct ParseOptions {
  bool readFiles = true;                ///< false: Include and spectrum files are checked for syntax only
  std::size_t maxIncludeDepth = 128;    ///< files open at once
  std::size_t maxIncludes = 1u << 17;   ///< Include directives in all: stops files that multiply each other
  std::size_t maxErrors = 200;          ///< parsing stops after so many errors
  Variables variables{};                ///< those of the command line; each must be used
  Variables* variablesAfter = nullptr;  ///< where all of them go in the end, with those that Define made
};

/// Reads PBRT-v3 scene files in order with one continuous state; "-" is standard input. One description per
/// WorldEnd. Never throws for broken input: all problems are in `diagnostics`, and when it has errors the
/// descriptions are incomplete and must not be rendered.
std::vector<SceneDescription> parseFiles(std::span<const std::filesystem::path> files,
                                         Diagnostics& diagnostics, const ParseOptions& options = {});

/// The same for text in memory. `shownName` is used in messages; relative file names are looked for in
/// `folder`. The text need not outlive the call.
std::vector<SceneDescription> parseText(std::string_view text, std::string_view shownName,
                                        const std::filesystem::path& folder, Diagnostics& diagnostics,
                                        const ParseOptions& options = {});

}  // namespace pbrtmedia
