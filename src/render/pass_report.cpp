// SPDX-License-Identifier: BSD-2-Clause
#include "render/pass_report.h"

#include <algorithm>
#include <tuple>

namespace pbrtmedia {
namespace {

/// Keeps the first `most` records in order of pixel, then sample. Since every unit notes its records in this
/// very order, what is kept does not depend on units, threads and passes.
template <class Record>
void mergeRecords(std::vector<Record>& all, const std::vector<Record>& more, std::size_t most) {
  if (more.empty()) return;
  all.insert(all.end(), more.begin(), more.end());
  const auto key = [](const Record& r) { return std::make_tuple(r.pixel.y, r.pixel.x, r.sample); };
  std::stable_sort(all.begin(), all.end(), [&](const Record& a, const Record& b) { return key(a) < key(b); });
  if (all.size() > most) all.resize(most);
}

}  // namespace

bool areComplete(std::span<const UnitReport> units) {
  return std::all_of(units.begin(), units.end(), [](const UnitReport& unit) { return unit.complete; });
}

void addReports(std::span<const UnitReport> units, bool isFirstPass, std::size_t maxRecords,
                RenderResult& result) {
  for (const UnitReport& unit : units) {
    result.samplesTaken += unit.samples;
    result.samplesAbandoned += unit.abandoned;
    if (isFirstPass) result.pixelsSampled += unit.pixelsSampled;
    result.counters.add(unit.counters);
    mergeRecords(result.dropped, unit.dropped, maxRecords);
    mergeRecords(result.mismatches, unit.mismatches, maxRecords);
    mergeRecords(result.violations, unit.violations, maxRecords);
  }
}

void addRecords(const RenderResult& others, std::size_t maxRecords, RenderResult& result) {
  mergeRecords(result.dropped, others.dropped, maxRecords);
  mergeRecords(result.mismatches, others.mismatches, maxRecords);
  mergeRecords(result.violations, others.violations, maxRecords);
  result.counters.worstBoundRatio =
      std::max(result.counters.worstBoundRatio, others.counters.worstBoundRatio);
}

void addPass(const RenderResult& taken, std::size_t maxRecords, RenderResult& result) {
  result.samplesTaken += taken.samplesTaken;
  result.samplesAbandoned += taken.samplesAbandoned;
  result.pixelsSampled += taken.pixelsSampled;
  result.counters.add(taken.counters);
  addRecords(taken, maxRecords, result);
}

}  // namespace pbrtmedia
