// SPDX-License-Identifier: BSD-2-Clause
#include "main/stop_signal.h"

#include <unistd.h>

#include <csignal>

namespace pbrtmedia {
namespace {

// The one place where a global is needed: a signal handler can reach nothing else.
std::atomic<bool> stopRequested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void onSignal(int number) {
  if (stopRequested.exchange(true)) {
    std::signal(number, SIG_DFL);
    std::raise(number);
    return;
  }
  constexpr char kText[] = "\nstopping; the image so far will be written (again to end at once)\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kText, sizeof kText - 1);
}

}  // namespace

StopSignal::StopSignal() {
  stopRequested = false;
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

StopSignal::~StopSignal() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

const std::atomic<bool>& StopSignal::flag() const { return stopRequested; }

}  // namespace pbrtmedia
