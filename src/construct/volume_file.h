// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "fields/nano_vdb_reader.h"
#include "scene/param_reader.h"

namespace pbrtmedia {

/// What kind of volume a file says it holds in its first bytes.
enum class VolumeFile { Other, OpenVdb, NanoVdb };
VolumeFile volumeFileOf(const std::filesystem::path& path);

/// The file of "string filename", which must be there. An OpenVDB file is an error that tells of vdb2pbrt.
std::optional<std::filesystem::path> requireVolumeFile(ParamReader& in);

/// Says at `named` how many values of a grid ("": the only one) were negative, if any were.
void tellNegatives(const NegativeDensities& negatives, std::string_view grid, const SourceLocation& named,
                   std::string_view context, Diagnostics& diagnostics);

}  // namespace pbrtmedia
