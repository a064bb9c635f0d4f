// SPDX-License-Identifier: BSD-2-Clause
#include "base/statistics.h"

#include <gtest/gtest.h>

namespace pbrtmedia {
namespace {

RenderCounters numbered(std::uint64_t first) {
  RenderCounters c;
  for (std::uint64_t* n :
       {&c.cameraSamples, &c.rays, &c.shadowRays, &c.densityLookups, &c.nullCollisions, &c.mediumScatterings,
        &c.surfaceScatterings, &c.boundViolations, &c.cappedEstimates, &c.stuckPaths, &c.mediumMismatches,
        &c.boundaryRepairs, &c.dropped[0], &c.dropped[1], &c.dropped[2]})
    *n = first++;
  return c;
}

TEST(RenderCounters, AddsEveryCount) {
  RenderCounters c = numbered(100);
  c.add(numbered(1000));
  std::uint64_t expected = 1100;
  for (const std::uint64_t n :
       {c.cameraSamples, c.rays, c.shadowRays, c.densityLookups, c.nullCollisions, c.mediumScatterings,
        c.surfaceScatterings, c.boundViolations, c.cappedEstimates, c.stuckPaths, c.mediumMismatches,
        c.boundaryRepairs, c.dropped[0], c.dropped[1], c.dropped[2]}) {
    EXPECT_EQ(n, expected);
    expected += 2;
  }
  // A new counter must be added here and in `add`.
  EXPECT_EQ(sizeof(RenderCounters), 16 * sizeof(std::uint64_t) + sizeof(std::optional<BoundViolation>));
}

TEST(RenderCounters, LeavesExamplesOfViolationsToWhoeverTakesThem) {
  RenderCounters a, b;
  b.violation = BoundViolation{"smoke", {}, {}, 2, 3, 1};
  a.add(b);
  EXPECT_FALSE(a.violation);
  EXPECT_EQ(b.violation->medium, "smoke");
}

TEST(RenderCounters, KeepsTheWorstBoundRatio) {
  RenderCounters a, b;
  a.worstBoundRatio = 1.5;
  b.worstBoundRatio = 1.25;
  a.add(b);
  EXPECT_EQ(a.worstBoundRatio, 1.5);
  b.add(a);
  EXPECT_EQ(b.worstBoundRatio, 1.5);
}

TEST(RenderCounters, TotalsDroppedSamplesOfAllCauses) {
  RenderCounters c;
  ++c.dropped[static_cast<std::size_t>(DropCause::NotANumber)];
  c.dropped[static_cast<std::size_t>(DropCause::Negative)] += 4;
  EXPECT_EQ(c.droppedTotal(), 5u);
}

}  // namespace
}  // namespace pbrtmedia
