// SPDX-License-Identifier: BSD-2-Clause
#include "base/stop_signal.h"

#include <unistd.h>

#include <csignal>
#include <cstring>
#include <ctime>

namespace pbrtmedia {
namespace {

// The one place where globals are needed: a signal handler can reach nothing else.
std::atomic<bool> stopRequested{false};
std::atomic<double> firstRequest{0};  // 0: none yet
std::atomic<const char*> stopNotice{nullptr};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<double>::is_always_lock_free &&
              std::atomic<const char*>::is_always_lock_free);

constexpr double kSameRequest = 0.5;  ///< seconds

double secondsNow() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void onSignal(int number) {
  const double now = secondsNow();
  double first = 0;
  if (!firstRequest.compare_exchange_strong(first, now)) {
    if (now - first < kSameRequest) return;
    std::signal(number, SIG_DFL);
    std::raise(number);
    return;
  }
  stopRequested = true;
  if (const char* notice = stopNotice) {
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, notice, std::strlen(notice));
  }
}

}  // namespace

StopSignal::StopSignal(const char* notice) {
  stopRequested = false;
  firstRequest = 0;
  stopNotice = notice;
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

StopSignal::~StopSignal() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

const std::atomic<bool>& StopSignal::flag() const { return stopRequested; }

}  // namespace pbrtmedia
