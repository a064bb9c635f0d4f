// SPDX-License-Identifier: BSD-2-Clause
#include "render/shared_report.h"

#include <cstdint>
#include <string>
#include <vector>

#include "base/byte_stream.h"
#include "render/pass_report.h"
#include "render/state_stream.h"

namespace pbrtmedia {
namespace {

/// Calls visit(sum) for every count that is a plain sum. The binding takes all members or does not compile: a
/// new member is a decision here.
template <class Visit>
void visitSums(RenderCounters& counters, const Visit& visit) {
  auto& [cameraSamples, rays, shadowRays, densityLookups, nullCollisions, mediumScatterings,
         surfaceScatterings, boundViolations, worstBoundRatio, cappedEstimates, stuckPaths, mediumMismatches,
         boundaryRepairs, dropped, violation] = counters;
  static_cast<void>(worstBoundRatio);  // a maximum
  static_cast<void>(violation);        // an example for the sample under way
  for (std::uint64_t* sum : {&cameraSamples, &rays, &shadowRays, &densityLookups, &nullCollisions,
                             &mediumScatterings, &surfaceScatterings, &boundViolations, &cappedEstimates,
                             &stuckPaths, &mediumMismatches, &boundaryRepairs})
    visit(*sum);
  for (std::uint64_t& sum : dropped) visit(sum);
}

/// Sums on their way to other ranks and back: first all are put in, then all are taken out.
class SumList {
 public:
  template <class Visit>
  void share(Ranks& ranks, const Visit& visitAll) {
    visitAll([&](std::uint64_t& sum) { numbers_.push_back(sum); });
    ranks.addUp(numbers_);
    std::size_t next = 0;
    visitAll([&](std::uint64_t& sum) { sum = numbers_[next++]; });
  }

 private:
  std::vector<std::uint64_t> numbers_;
};

constexpr double kNanoseconds = 1e9;

}  // namespace

void addUp(Ranks& ranks, RenderCounters& counters) {
  if (ranks.isAlone()) return;
  SumList().share(ranks, [&](const auto& visit) { visitSums(counters, visit); });
}

void addUp(Ranks& ranks, const Scene& scene, std::size_t maxRecords, PassReport& report) {
  if (ranks.isAlone()) return;
  const RenderResult own = report.taken;
  RenderResult& all = report.taken;
  std::uint64_t incomplete = report.isComplete ? 0 : 1;
  auto nanoseconds = static_cast<std::uint64_t>(report.cpuSeconds * kNanoseconds);
  std::uint64_t records = own.dropped.size() + own.mismatches.size() + own.violations.size() +
                          (own.counters.worstBoundRatio > 0 ? 1 : 0);
  SumList().share(ranks, [&](const auto& visit) {
    visit(all.samplesTaken);
    visit(all.samplesAbandoned);
    visit(all.pixelsSampled);
    visitSums(all.counters, visit);
    visit(incomplete);
    visit(nanoseconds);
    visit(records);
  });
  report.isComplete = incomplete == 0;
  report.cpuSeconds = static_cast<double>(nanoseconds) / kNanoseconds;
  if (records == 0) return;
  ByteWriter out;
  writeResult(out, scene, own);
  const std::vector<std::string> texts = ranks.gather(out.text());
  for (std::size_t r = 1; r < texts.size(); ++r) {
    ByteReader in(texts[r]);
    addRecords(readResult(in, scene), maxRecords, all);
  }
}

}  // namespace pbrtmedia
