// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tools/medialab/trials.h"

namespace pbrtmedia {

/// How a job in a process of its own ended.
struct IsolatedResult {
  enum class End {
    Done,
    OutOfTime,  ///< used up its processor time: it hangs, or costs too much
    Threw,      ///< `message` tells what
    Crashed,    ///< a signal, told in `message`
    NotRun      ///< stopped before
  };
  End end = End::NotRun;
  std::string message;
  TrialStats stats;
};

/// Runs each job in a child process, up to `parallel` at a time, with a limit on its processor seconds, so
/// that neither a crash nor a hang ends the lab. `done(i)` tells that job i ended. When `stop` is set,
/// running children are ended and the rest is not run. Call without other threads of our own running.
std::vector<IsolatedResult> runIsolated(const std::vector<std::function<TrialStats()>>& jobs,
                                        unsigned parallel, double seconds, const std::atomic<bool>& stop,
                                        const std::function<void(std::size_t)>& done);

}  // namespace pbrtmedia
