// SPDX-License-Identifier: BSD-2-Clause
#include "base/stop_signal.h"

#include <semaphore.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <ctime>
#include <thread>

namespace pbrtmedia {
namespace {

// The one place where globals are needed: a signal handler can reach nothing else.
std::atomic<bool> stopRequested{false};
std::atomic<double> firstRequest{0};  // 0: none yet
std::atomic<const char*> stopNotice{nullptr};
sem_t watchIsTold;  // of signals and of its end; lives as long as the process
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<double>::is_always_lock_free &&
              std::atomic<const char*>::is_always_lock_free);

constexpr double kSameRequest = 0.5;  ///< seconds
constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

double secondsNow() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

timespec timeAt(double seconds) {
  const double whole = std::floor(seconds);
  return {static_cast<time_t>(whole), static_cast<long>((seconds - whole) * 1e9)};
}

void request(StopCause cause) {
  StopCause none = StopCause::None;
  interruption::requested.compare_exchange_strong(none, cause);
  stopRequested = true;
}

/// What the first request does. Safe in a signal handler.
void begin() {
  request(StopCause::Signal);
  if (const char* notice = stopNotice) {
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, notice, std::strlen(notice));
  }
  ::sem_post(&watchIsTold);
}

void onSignal(int number) {
  const int savedError = errno;
  const double now = secondsNow();
  double first = 0;
  if (!firstRequest.compare_exchange_strong(first, now)) {
    if (now - first >= kSameRequest) {
      std::signal(number, SIG_DFL);
      std::raise(number);
    }
    errno = savedError;
    return;
  }
  begin();
  errno = savedError;
}

}  // namespace

/// A thread that sleeps until the time is up or a signal came, and then until the grace of paths is over.
class StopSignal::Watch {
 public:
  Watch(double deadline, bool abandonsPaths) : deadline_(deadline) {
    while (::sem_trywait(&watchIsTold) == 0) {  // of an earlier watch
    }
    thread_ = std::thread([this, abandonsPaths] {
      while (!done_ && !stopRequested) {
        const double end = deadline_;
        if (!waitUntil(end) && end >= deadline_) request(StopCause::Time);
      }
      if (!abandonsPaths || done_) return;
      const double graceEnd = secondsNow() + kGrace;
      while (waitUntil(graceEnd) && !done_) {
      }
      if (!done_) interruption::abandonsPaths = true;
    });
  }
  ~Watch() {
    done_ = true;
    ::sem_post(&watchIsTold);
    thread_.join();
  }
  void extend(double seconds) { deadline_ = deadline_ + seconds; }
  void endAt(double deadline) {
    const bool isEarlier = deadline < deadline_;
    deadline_ = deadline;
    if (isEarlier) ::sem_post(&watchIsTold);  // it waits for the old one
  }
  double deadline() const { return deadline_; }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  /// Whether something was told before `deadline`; the end of the watch counts.
  bool waitUntil(double deadline) {
    const bool isEndless = !(deadline < 1e12);
    const timespec end = timeAt(isEndless ? 0 : deadline);
    for (;;) {
      const int failed =
          isEndless ? ::sem_wait(&watchIsTold) : ::sem_clockwait(&watchIsTold, CLOCK_MONOTONIC, &end);
      if (failed == 0) return true;
      if (errno != EINTR) return false;
    }
  }

  std::atomic<double> deadline_;  // one thread writes
  std::atomic<bool> done_{false};
  std::thread thread_;
};

StopSignal::StopSignal(const Params& params) {
  [[maybe_unused]] static const int initialised = ::sem_init(&watchIsTold, 0, 0);
  stopRequested = false;
  firstRequest = 0;
  stopNotice = params.notice;
  interruption::requested = StopCause::None;
  interruption::abandonsPaths = false;
  if (params.timeLimit < kNever || params.abandonsPaths) {
    watch_ = std::make_unique<Watch>(secondsNow() + params.timeLimit, params.abandonsPaths);
  }
  for (const int number : kSignals) {
    const auto before = std::signal(number, onSignal);
    if (number == SIGHUP && before == SIG_IGN) std::signal(number, SIG_IGN);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

StopSignal::~StopSignal() {
  for (const int number : kSignals) {
    const auto before = std::signal(number, SIG_DFL);
    if (number == SIGHUP && before == SIG_IGN) std::signal(number, SIG_IGN);
  }
  std::signal(SIGPIPE, SIG_DFL);
  watch_.reset();
  interruption::requested = StopCause::None;
  interruption::abandonsPaths = false;
}

const std::atomic<bool>& StopSignal::flag() const { return stopRequested; }

void StopSignal::extend(double seconds) const {
  if (watch_) watch_->extend(seconds);
}

void StopSignal::endIn(double seconds) const {
  if (watch_) watch_->endAt(secondsNow() + seconds);
}

double StopSignal::secondsLeft() const { return watch_ ? watch_->deadline() - secondsNow() : kNever; }

void StopSignal::say(const char* notice) { stopNotice = notice; }

void StopSignal::ask() {
  double none = 0;
  if (firstRequest.compare_exchange_strong(none, secondsNow())) begin();
}

}  // namespace pbrtmedia
