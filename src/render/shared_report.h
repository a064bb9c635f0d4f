// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

#include "base/statistics.h"
#include "render/ranks.h"
#include "render/render_result.h"

namespace pbrtmedia {

class Scene;

/// Makes counters those of all ranks together; the worst ratio stays this rank's own.
void addUp(Ranks& ranks, RenderCounters& counters);

/// What a pass came to.
struct PassReport {
  RenderResult taken;      ///< in this pass: samples, counters, records
  bool isComplete = true;  ///< all its samples are taken
  double cpuSeconds = 0;   ///< of the render so far
};

/// Makes a report that of all ranks together: sums on all of them, records and the worst ratio on the first.
/// `maxRecords`: of each kind are kept.
void addUp(Ranks& ranks, const Scene& scene, std::size_t maxRecords, PassReport& report);

}  // namespace pbrtmedia
