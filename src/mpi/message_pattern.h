// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>

namespace pbrtmedia {

/// What the ranks of a render would send to each other in a pass of one sample a pixel, for 1 to 1024 ranks:
/// the very shares of a render (render/pass_shares.h), without rendering. A table for docs/scaling.md; tiles
/// cost as much as a cloud in the middle of the picture makes them.
std::string messagePattern();

}  // namespace pbrtmedia
