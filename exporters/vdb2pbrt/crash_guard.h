// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <string>

namespace pbrtmedia {

/// Does `run` in a process of its own, as OpenVDB reads damaged files without asking: should that process
/// crash or ask for more memory than the machine has, what comes out is a message. Answers the exit status of
/// `run`, which reports its own errors; throws std::runtime_error that says `what` went wrong ("reading
/// a.vdb") after a crash. Call it before any thread is started.
int runGuarded(const std::string& what, const std::function<int()>& run);

}  // namespace pbrtmedia
