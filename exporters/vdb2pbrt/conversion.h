// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "vdb2pbrt/nvdb_output.h"
#include "vdb2pbrt/pbrt_include.h"
#include "vdb2pbrt/vdb_density.h"

namespace pbrtmedia {

enum class DenseForm { None, Inline, Gz };

/// One run of vdb2pbrt, but for the frames.
struct ConversionOptions {
  std::vector<std::string> grids;  ///< names, numbers or unique beginnings; empty: the only density
  bool allGrids = false;           ///< every density of the file
  std::string medium;              ///< name of the medium when there is one grid; "": the grid's name
  NegativeRule negative = NegativeRule::Clamp;
  DenseForm dense = DenseForm::None;
  NvdbOptions nvdb;
  IncludeOptions include;
};

/// Called with one line for the user.
using Notice = std::function<void(const std::string&)>;

/// Converts one .vdb file: writes `output` (a .pbrt include; with DenseForm::Gz gzip-compressed) and, unless
/// dense, the .nvdb file of the same name beside it. Throws std::runtime_error or SceneError; then neither
/// file has been touched, or the .nvdb file alone.
void convertVdb(const std::filesystem::path& input, const std::filesystem::path& output,
                const ConversionOptions& options, const Notice& notice);

/// What --info prints of a .vdb or .nvdb file: every grid with its type, class, box, transformation, range
/// and memory, as far as the file tells; densities of .vdb files are read for it.
std::string describeVolume(const std::filesystem::path& file);

}  // namespace pbrtmedia
