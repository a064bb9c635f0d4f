// SPDX-License-Identifier: BSD-2-Clause
#include "fields/exploration.h"

#include <gtest/gtest.h>

namespace pbrtmedia {
namespace {

Exploration planOf(std::int64_t x, std::int64_t y, std::int64_t z, int passes, std::uint64_t lookups) {
  return planExploration(LatticeShape{{x, y, z}}, passes, lookups);
}

TEST(PlanExploration, TakesAllPassesOverEverySuperVoxelWhereTheyAreAffordable) {
  const Exploration plan = planOf(32, 32, 32, 4, 1u << 21);
  EXPECT_EQ(plan.passes, 4);
  EXPECT_EQ(plan.blockEdge, 1);
  EXPECT_EQ(plan.blockCount(), 32768u);
  EXPECT_EQ(plan.lookups(), 1u << 21);
  EXPECT_EQ(planOf(32, 32, 32, 4, 1u << 30).lookups(), 1u << 21) << "no more than wished";
}

TEST(PlanExploration, SavesPassesFirstAndThenMakesBlocks) {
  EXPECT_EQ(planOf(32, 32, 32, 4, (1u << 21) - 1).passes, 3);
  const Exploration blocks = planOf(32, 32, 32, 4, 32768 * 16 - 1);
  EXPECT_EQ(blocks.blockEdge, 2);
  EXPECT_EQ(blocks.passes, 4);
  const Exploration large = planOf(256, 256, 256, 4, 1u << 21);
  EXPECT_EQ(large.blockEdge, 8);
  EXPECT_EQ(large.passes, 4);
  EXPECT_EQ(large.lookups(), 1u << 21);
}

TEST(PlanExploration, NeverExceedsItsLookups) {
  for (const std::int64_t n : {1, 2, 3, 17, 100, 255}) {
    for (const std::uint64_t lookups : {0u, 15u, 16u, 100u, 5000u, 1000000u}) {
      for (const int passes : {0, 1, 4, 1024}) {
        const Exploration plan = planOf(n, 1, 2 * n, passes, lookups);
        EXPECT_LE(plan.lookups(), lookups) << n << ' ' << passes;
        EXPECT_LE(plan.passes, passes);
        EXPECT_EQ(plan.passes > 0, passes > 0 && lookups >= 16) << n << ' ' << lookups;
        EXPECT_GE(plan.blocks.x * plan.blockEdge, n);
        EXPECT_GE(plan.blocks.z * plan.blockEdge, 2 * n);
        EXPECT_EQ(plan.blocks.y, 1);
      }
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
