// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <atomic>

namespace pbrtmedia {

/// While alive, the first SIGINT or SIGTERM sets the flag, so that a run ends with what it has; a second one,
/// half a second later or more, ends the process at once. (Some senders deliver one request twice: to the
/// process and to its group.) One object at a time.
class StopSignal {
 public:
  /// `notice`: written to standard error when the first signal comes; must outlive the object. Null: nothing.
  explicit StopSignal(const char* notice = nullptr);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;
  const std::atomic<bool>& flag() const;
  explicit operator bool() const { return flag(); }
};

}  // namespace pbrtmedia
