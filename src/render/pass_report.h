// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/render_result.h"

namespace pbrtmedia {

/// What came of one unit of work (a tile of pixels, a chain) in one pass, besides radiance.
struct UnitReport {
  RenderCounters counters;
  std::uint64_t samples = 0, abandoned = 0;
  std::uint64_t oddSamples = 0;     ///< those of odd index among the samples
  std::uint64_t pixelsSampled = 0;  ///< with a sample of this pass at least
  std::vector<DroppedSample> dropped;
  std::vector<MediumMismatch> mismatches;
  std::vector<ViolationRecord> violations;
  bool complete = false;  ///< all its samples of this pass are taken
};

/// Whether the units of a pass took all their samples.
bool areComplete(std::span<const UnitReport> units);

/// Adds what the units of a pass report, which stand in a fixed order and each note their records in order
/// of pixel, then sample: so sums and records do not depend on units, threads and passes. `maxRecords`: of
/// each kind are kept.
void addReports(std::span<const UnitReport> units, bool isFirstPass, std::size_t maxRecords,
                RenderResult& result);

/// Adds records (and the worst ratio of a violation) of samples that others took.
void addRecords(const RenderResult& others, std::size_t maxRecords, RenderResult& result);
/// Adds a whole pass.
void addPass(const RenderResult& taken, std::size_t maxRecords, RenderResult& result);

}  // namespace pbrtmedia
