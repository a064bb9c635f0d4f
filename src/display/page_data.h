// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>

#include "display/feed.h"

namespace pbrtmedia {

// What the page asks for again and again, as it travels.

/// JSON, one object; what is not known is null.
std::string statusText(const RenderStatus& status);

/// The numbers of an image behind a header of 24 bytes, all little endian: "PMI1", then uint32 sequence,
/// width, height, number of channels and bytes of their names (each ended by a zero byte, then zeros up to a
/// multiple of four), then the names. The floats that follow are Image::data as it lies in memory.
std::string imageHeader(const Snapshot& snapshot);

}  // namespace pbrtmedia
