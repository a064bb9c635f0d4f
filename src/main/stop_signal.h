// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <atomic>

namespace pbrtmedia {

/// While alive, the first SIGINT or SIGTERM sets the flag, so that the render ends with a valid image; a
/// second one ends the process at once. One object at a time.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;
  const std::atomic<bool>& flag() const;
};

}  // namespace pbrtmedia
