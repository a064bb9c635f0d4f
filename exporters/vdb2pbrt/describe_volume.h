// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <string>

namespace pbrtmedia {

/// What --info prints of a .vdb or .nvdb file: every grid with its type, class, box, transformation, range
/// and memory, as far as the file tells; densities of .vdb files are read for it.
std::string describeVolume(const std::filesystem::path& file);

}  // namespace pbrtmedia
