// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <atomic>
#include <string>

namespace pbrtmedia {

/// Why a run ends before its end.
enum class StopCause { None, Signal, Time };

/// Thrown to leave what is under way, nothing of which is kept, because the run is to stop. No
/// std::exception: nobody may take it for a fault of what is read.
class Interrupted {
 public:
  explicit Interrupted(StopCause cause) : cause_(cause) {}
  StopCause cause() const { return cause_; }
  /// "the time of --time was up" or "a signal asked for it".
  std::string reason() const;

 private:
  StopCause cause_;
};

/// What StopSignal asks of everybody. Global, as a signal handler can reach nothing else and the innermost
/// loops of parsing, construction and tracking have to see it; only StopSignal writes it.
namespace interruption {
inline std::atomic<StopCause> requested{StopCause::None};
inline std::atomic<bool> abandonsPaths{false};
static_assert(std::atomic<StopCause>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);
[[noreturn]] void leave();
}  // namespace interruption

/// For parsing and construction: throws Interrupted as soon as the run is to stop. One load that hardly ever
/// misses the cache: cheap enough for every few hundred instructions.
inline void leaveIfStopped() {
  if (interruption::requested.load(std::memory_order_relaxed) != StopCause::None) [[unlikely]] {
    interruption::leave();
  }
}

/// For paths: throws Interrupted when the run is to stop and those under way had a moment to end by
/// themselves.
inline void leaveIfAbandoned() {
  if (interruption::abandonsPaths.load(std::memory_order_relaxed)) [[unlikely]] {
    interruption::leave();
  }
}

}  // namespace pbrtmedia
