// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <string>

namespace pbrtmedia {

/// Why `writeFileAtomically` could not write `path` now: "folder "x" does not exist", "it is a folder", or
/// the system's reason for refusing a file of that length of name there; "" when it could. Nothing stays
/// behind and an existing file is not touched, so hours of work can be preceded by the question.
std::string unwritableReason(const std::filesystem::path& path);

/// Throws std::runtime_error that names file and reason where there is one.
void checkWritable(const std::filesystem::path& path);

}  // namespace pbrtmedia
