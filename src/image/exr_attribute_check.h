// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <string_view>

namespace pbrtmedia {

/// Walks over the attributes of the OpenEXR header that starts at `position` of a file; returns where it
/// ends. Throws std::runtime_error when an attribute is longer than the file, or its stated size is not the
/// one that its type has. OpenEXR reads values by their type and skips by nothing, so a wrong size would let
/// it take the following bytes for names and sizes, and sizes for memory.
std::size_t skipExrHeader(std::string_view file, std::size_t position);

}  // namespace pbrtmedia
