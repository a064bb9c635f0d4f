// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "scene/param_list.h"
#include "scene/variables.h"

namespace pbrtmedia {

struct PrintOptions {
  Variables variables{};              ///< those of the command line
  bool meshesToPly = false;           ///< --toply: big triangle meshes become PLY files
  std::size_t minPlyIndices = 500;    ///< meshes with fewer indices stay in the text
  std::filesystem::path plyFolder{};  ///< where the files are written; "" is the working directory
  std::string plyPrefix = "mesh";     ///< files are <prefix>_00001.ply, <prefix>_00002.ply, …
};

/// A parameter list as the language has it, on one line and in order of its entries' texts: equal lists have
/// the same text. Numbers are the shortest of their values, spectra are rgb.
std::string textOf(const ParamList& params);

/// --cat: a normalised copy of scene files: one directive per line, indented by block, parameters on lines of
/// their own, comments kept, Include not followed, spectra as rgb. What is printed parses to the same scene.
/// Problems go to `diagnostics`; printing stops at a statement that cannot be read. Throws std::runtime_error
/// when a mesh file cannot be written.
void printFiles(std::span<const std::filesystem::path> files, std::ostream& out, Diagnostics& diagnostics,
                const PrintOptions& options = {});
void printText(std::string_view text, std::string_view shownName, const std::filesystem::path& folder,
               std::ostream& out, Diagnostics& diagnostics, const PrintOptions& options = {});

}  // namespace pbrtmedia
