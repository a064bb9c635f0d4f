// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "base/statistics.h"
#include "singlescattering/main_part.h"
#include "world/media_stretch.h"

namespace pbrtmedia {

/// Whether a stretch can be explored: it ends, and its media are of the exponential law.
bool isExplorable(const MediaStretch& stretch);

/// Adds `count` equidistant explorers of a stretch, the first at `offset` (in [0, 1)) of a step. Differences
/// are those of each to the line through its neighbours: a cautious guess.
void explore(const MediaStretch& stretch, std::size_t count, double offset, RenderCounters& counters,
             std::vector<Explorer>& explorers);

}  // namespace pbrtmedia
