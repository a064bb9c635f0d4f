// SPDX-License-Identifier: BSD-2-Clause
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace pbrtmedia {
namespace {

TEST(ParallelFor, CallsEachIndexOnceForAnyNumberOfThreads) {
  for (const unsigned threads : {1u, 2u, 5u}) {
    const ThreadLimit limit(threads);
    std::vector<std::atomic<int>> calls(1000);
    parallelFor(calls.size(), [&](std::size_t i) { ++calls[i]; });
    for (const auto& n : calls) ASSERT_EQ(n.load(), 1);
  }
}

TEST(ParallelFor, DoesNothingForACountOfZero) {
  bool called = false;
  parallelFor(0, [&](std::size_t) { called = true; });
  EXPECT_FALSE(called);
}

TEST(ParallelFor, RethrowsTheExceptionOfABody) {
  EXPECT_THROW(parallelFor(100,
                           [](std::size_t i) {
                             if (i == 37) throw std::runtime_error("37");
                           }),
               std::runtime_error);
}

TEST(ParallelFor, MayBeNested) {
  std::atomic<int> sum{0};
  parallelFor(8,
              [&](std::size_t i) { parallelFor(8, [&](std::size_t k) { sum += static_cast<int>(i * k); }); });
  EXPECT_EQ(sum.load(), 28 * 28);
}

TEST(ThreadLimit, HoldsWhileAliveAndStaysOnThisThreadAtOne) {
  const unsigned before = threadCount();
  {
    const ThreadLimit limit(1);
    EXPECT_EQ(threadCount(), 1u);
    const auto caller = std::this_thread::get_id();
    std::atomic<int> elsewhere{0};
    parallelFor(200, [&](std::size_t) { elsewhere += std::this_thread::get_id() != caller; });
    EXPECT_EQ(elsewhere.load(), 0);
  }
  EXPECT_EQ(threadCount(), before);
}

TEST(ThreadLimit, ZeroMeansOneThreadPerProcessor) {
  const ThreadLimit limit(0);
  EXPECT_GE(threadCount(), 1u);
  EXPECT_LE(threadCount(), std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace
}  // namespace pbrtmedia
