// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <atomic>
#include <limits>
#include <memory>

#include "base/interruption.h"

namespace pbrtmedia {

/// While alive, the first SIGINT, SIGTERM or SIGHUP, or the end of the time, asks the run to stop
/// (base/interruption.h), so that it ends with what it has. A second signal, half a second after the first or
/// later, ends the process at once. (Some senders deliver one request twice: to the process and to its
/// group.) SIGPIPE is ignored: who stops reading messages does not end a render. Where SIGHUP is ignored from
/// the start (nohup) it stays so. One object at a time.
class StopSignal {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  /// Paths that are under way when the run is to stop may go on for so long, seconds: nearly all end by
  /// themselves then, so that hardly any is left out for its length.
  static constexpr double kGrace = 0.1;

  struct Params {
    /// Written to standard error when the first signal comes; must outlive the object. Null: nothing.
    const char* notice = nullptr;
    double timeLimit = kNever;   ///< seconds from now
    bool abandonsPaths = false;  ///< kGrace after the request, paths under way are left too
  };
  StopSignal() : StopSignal(Params{}) {}
  explicit StopSignal(const char* notice) : StopSignal(Params{.notice = notice}) {}
  explicit StopSignal(const Params& params);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  const std::atomic<bool>& flag() const;
  /// Lets the time end so many seconds later, for what was done meanwhile that is not to count.
  void extend(double seconds) const;
  /// Lets the time end so many seconds from now instead.
  void endIn(double seconds) const;
  /// Until the time ends.
  double secondsLeft() const;
  explicit operator bool() const { return flag(); }
  /// What the first signal from now on prints.
  static void say(const char* notice);
  /// Asks as the first signal does, for those who ask in another way; asked again it changes nothing. While
  /// an object is alive; thread-safe.
  static void ask();

 private:
  class Watch;
  std::unique_ptr<Watch> watch_;
};

}  // namespace pbrtmedia
