// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <vector>

#include "base/bounds.h"
#include "image/image.h"

namespace pbrtmedia {

/// The tiles of `after`, row by row, in which a number differs from that of `before` in any bit; all of them
/// when `before` is null or another size or channels. In pixels of the image, from (0, 0). `edge` > 0: of a
/// tile; those at the right and at the bottom are what is left.
std::vector<Bounds2i> changedTiles(const Image* before, const Image& after, int edge);

}  // namespace pbrtmedia
