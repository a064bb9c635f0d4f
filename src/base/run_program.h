// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <string>

namespace pbrtmedia {

/// The body of a program's main: does `run`, whose value is the exit status, and sees that all it printed
/// arrived. Whatever went wrong becomes one line "name: place: error: what" on standard error and status 1.
int runProgram(const std::string& name, const std::function<int()>& run);

}  // namespace pbrtmedia
