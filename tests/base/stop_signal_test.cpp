// SPDX-License-Identifier: BSD-2-Clause
#include "base/stop_signal.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace pbrtmedia {
namespace {

TEST(StopSignal, SetsItsFlagOnTheFirstRequest) {
  for (const int number : {SIGINT, SIGTERM}) {
    const StopSignal stop;
    EXPECT_FALSE(stop.flag());
    std::raise(number);
    EXPECT_TRUE(stop);
  }
  const StopSignal again;
  EXPECT_FALSE(again.flag());
}

TEST(StopSignal, TakesOneRequestDeliveredTwiceForOne) {
  const StopSignal stop;
  std::raise(SIGINT);
  std::raise(SIGINT);
  std::raise(SIGTERM);
  EXPECT_TRUE(stop);
}

TEST(StopSignalDeathTest, EndsTheProcessOnASecondRequest) {
  const auto twice = [] {
    const StopSignal stop("first\n");
    std::raise(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    std::raise(SIGINT);
  };
  EXPECT_EXIT(twice(), testing::KilledBySignal(SIGINT), "first");
}

}  // namespace
}  // namespace pbrtmedia
