// SPDX-License-Identifier: BSD-2-Clause
#include "render/schedule.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace pbrtmedia {
namespace {

/// Sizes of all passes, when each sample index costs `perIndex` look-ups.
std::vector<int> sizes(const RenderOptions& options, Schedule::Plan plan, std::uint64_t perIndex = 0) {
  Schedule schedule(plan, options);
  std::vector<int> all;
  std::uint64_t lookups = 0;
  std::int64_t next = plan.first;
  while (const auto pass = schedule.next(lookups)) {
    EXPECT_EQ(pass->first, next);
    next += pass->count;
    lookups += perIndex * static_cast<std::uint64_t>(pass->count);
    all.push_back(pass->count);
  }
  return all;
}

TEST(Schedule, TakesAllSamplesInPassesThatMemoryAllows) {
  EXPECT_EQ(sizes({}, {.first = 0, .end = 10, .mostPerPass = 4}), (std::vector<int>{4, 4, 2}));
  EXPECT_EQ(sizes({.firstSample = 7}, {.first = 7, .end = 10, .mostPerPass = 4}), (std::vector<int>{3}));
  EXPECT_EQ(sizes({.samplesPerPass = 3}, {.first = 0, .end = 10, .mostPerPass = 4}),
            (std::vector<int>{3, 3, 3, 1}));
  EXPECT_TRUE(sizes({}, {.first = 5, .end = 5, .mostPerPass = 4}).empty());
}

TEST(Schedule, BeginsWithSmallPassesWhereItMayBeStopped) {
  const std::atomic<bool> stop{false};
  EXPECT_EQ(sizes({.stop = &stop}, {.first = 0, .end = 30, .mostPerPass = 10}),
            (std::vector<int>{1, 2, 4, 8, 10, 5}));
  EXPECT_EQ(sizes({.timeLimit = 1e6}, {.first = 0, .end = 4, .mostPerPass = 10}),
            (std::vector<int>{1, 2, 1}));
}

TEST(Schedule, GrowsNoFasterThanAsked) {
  const std::vector<int> passes = sizes({.mostGrowth = .25}, {.first = 0, .end = 40, .mostPerPass = 6});
  EXPECT_EQ(passes, (std::vector<int>{1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 3, 3, 4, 5, 6, 6, 1}));
}

TEST(Schedule, MakesPassesThatTakeNoLongerThanAsked) {
  const RenderOptions options{.mostSecondsPerPass = .02};
  // An index takes a millisecond at least: no pass may have more than twenty once that is known.
  Schedule schedule({.first = 100, .end = 300, .mostPerPass = 64}, options);
  std::vector<int> passes;
  while (const auto pass = schedule.next(0)) {
    passes.push_back(pass->count);
    std::this_thread::sleep_for(std::chrono::milliseconds(pass->count));
  }
  EXPECT_EQ(passes.front(), 64) << "nothing is known yet";
  for (std::size_t i = 1; i < passes.size(); ++i) EXPECT_LE(passes[i], 20);
  EXPECT_EQ(sizes({.mostSecondsPerPass = 1e-12}, {.first = 0, .end = 3, .mostPerPass = 1}),
            (std::vector<int>{1, 1, 1}));
}

TEST(Schedule, ComesToABudgetOfLookupsWithinOneIndex) {
  // 100 look-ups an index: the tenth index reaches 950.
  const std::vector<int> passes =
      sizes({.mostLookups = 950}, {.first = 0, .end = 1000, .mostPerPass = 64}, 100);
  EXPECT_EQ(passes, (std::vector<int>{1, 8, 1}));
  EXPECT_EQ(sizes({.mostLookups = 950}, {.first = 0, .end = 5, .mostPerPass = 64}, 100),
            (std::vector<int>{1, 4}));
  EXPECT_EQ(sizes({.mostLookups = 1}, {.first = 0, .end = 5, .mostPerPass = 64}, 0), (std::vector<int>{1, 4}))
      << "no look-ups at all";
  EXPECT_EQ(Schedule({.first = 0, .end = 5, .mostPerPass = 64}, {.mostLookups = 10}).next(20).value().count,
            1)
      << "a warm-up has taken them all, and there is no image yet";
  RenderOptions options{.mostLookups = 950};
  Schedule schedule({.first = 0, .end = 1000, .mostPerPass = 64}, options);
  EXPECT_EQ(schedule.reasonToStop(949), EarlyStop::None);
  EXPECT_EQ(schedule.reasonToStop(950), EarlyStop::Lookups);
  EXPECT_TRUE(schedule.next(0));
  EXPECT_FALSE(schedule.next(950));
}

TEST(Schedule, SaysWhyItStops) {
  std::atomic<bool> stop{false};
  const RenderOptions options{.timeLimit = 1000, .stop = &stop};
  Schedule schedule({.first = 0, .end = 1000, .mostPerPass = 64}, options);
  EXPECT_EQ(schedule.reasonToStop(0), EarlyStop::None);
  EXPECT_FALSE(schedule.shouldStop());
  schedule.leaveOut({.wall = -1001});  // as if they had gone by
  EXPECT_EQ(schedule.reasonToStop(0), EarlyStop::Time);
  EXPECT_TRUE(schedule.shouldStop());
  EXPECT_FALSE(schedule.next(0));
  schedule.leaveOut({.wall = 2001, .cpu = 500});
  EXPECT_EQ(schedule.reasonToStop(0), EarlyStop::None) << "what is left out does not count";
  EXPECT_LT(schedule.time().wall, -.5);
  EXPECT_LT(schedule.time().cpu, -.5);
  stop = true;
  EXPECT_EQ(schedule.reasonToStop(0), EarlyStop::Asked);
  EXPECT_TRUE(schedule.shouldStop());
}

}  // namespace
}  // namespace pbrtmedia
