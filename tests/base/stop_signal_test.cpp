// SPDX-License-Identifier: BSD-2-Clause
#include "base/stop_signal.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include "base/stopwatch.h"

namespace pbrtmedia {
namespace {

TEST(StopSignal, SetsItsFlagOnTheFirstRequest) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
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

TEST(StopSignal, IsAskedWithoutASignalAsOftenAsAnybodyLikes) {
  const StopSignal stop;
  StopSignal::ask();
  EXPECT_TRUE(stop);
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  StopSignal::ask();  // a second signal would end this process
  EXPECT_TRUE(stop);
}

StopCause causeOfLeaving(void (*leave)()) {
  try {
    leave();
  } catch (const Interrupted& stopped) {
    return stopped.cause();
  }
  return StopCause::None;
}

void waitFor(const std::function<bool()>& holds) {
  for (int i = 0; i < 2000 && !holds(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(StopSignal, MakesEverybodyLeaveAndPathsAMomentLater) {
  const StopSignal stop({.abandonsPaths = true});
  EXPECT_EQ(causeOfLeaving(leaveIfStopped), StopCause::None);
  EXPECT_EQ(causeOfLeaving(leaveIfAbandoned), StopCause::None);
  const auto start = std::chrono::steady_clock::now();
  std::raise(SIGTERM);
  EXPECT_EQ(causeOfLeaving(leaveIfStopped), StopCause::Signal);
  waitFor([] { return causeOfLeaving(leaveIfAbandoned) == StopCause::Signal; });
  EXPECT_EQ(causeOfLeaving(leaveIfAbandoned), StopCause::Signal);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GE(seconds, StopSignal::kGrace);
}

TEST(StopSignal, StopsWhenTheTimeIsUpAndLeavesNothingBehind) {
  {
    const StopSignal stop({.timeLimit = 0.02});
    EXPECT_FALSE(stop);
    waitFor([&] { return stop.flag().load(); });
    EXPECT_TRUE(stop);
    EXPECT_EQ(causeOfLeaving(leaveIfStopped), StopCause::Time);
    EXPECT_EQ(causeOfLeaving(leaveIfAbandoned), StopCause::None) << "only who asks for it abandons paths";
  }
  EXPECT_EQ(causeOfLeaving(leaveIfStopped), StopCause::None);
  const StopSignal again({.timeLimit = 1e300});
  EXPECT_FALSE(again);
}

TEST(StopSignal, LetsTheTimeEndLaterForWhatDoesNotCount) {
  const StopSignal stop({.timeLimit = 0.1});
  const auto start = std::chrono::steady_clock::now();
  stop.extend(0.1);
  stop.extend(0.2);
  waitFor([&] { return stop.flag().load(); });
  EXPECT_TRUE(stop);
  EXPECT_EQ(causeOfLeaving(leaveIfStopped), StopCause::Time);
  EXPECT_GE(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 0.38);
  const StopSignal endless;
  endless.extend(1);
  EXPECT_FALSE(endless);
}

TEST(StopSignal, LetsTheTimeEndWhenItIsTold) {
  {
    const StopSignal stop({.abandonsPaths = true});
    EXPECT_EQ(stop.secondsLeft(), StopSignal::kNever);
    stop.endIn(30);
    EXPECT_NEAR(stop.secondsLeft(), 30, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_FALSE(stop);
    const Stopwatch watch;
    stop.endIn(.05);  // sooner than it waits for
    waitFor([&] { return stop.flag().load(); });
    EXPECT_TRUE(stop);
    EXPECT_GE(watch.seconds(), .05);
    EXPECT_EQ(causeOfLeaving(leaveIfStopped), StopCause::Time);
  }
  const StopSignal again({.timeLimit = .4, .abandonsPaths = true});
  again.endIn(StopSignal::kNever);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_FALSE(again);
}

TEST(StopSignal, LeavesAHangupIgnoredWhereItWas) {
  std::signal(SIGHUP, SIG_IGN);  // as nohup does
  {
    const StopSignal stop;
    std::raise(SIGHUP);
    EXPECT_FALSE(stop);
  }
  std::raise(SIGHUP);  // would end this process
  std::signal(SIGHUP, SIG_DFL);
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
