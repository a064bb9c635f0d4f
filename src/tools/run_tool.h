// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>

#include "base/run_program.h"
#include "tools/command_line.h"

namespace pbrtmedia {

/// The body of a tool's main: parses the command line, then does `run`, which a command's callback may have
/// stored meanwhile, as runProgram. A wrong command line gives status 1.
inline int runTool(CLI::App& app, int argc, char** argv, const std::function<int()>& run) {
  const std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
  if (const std::optional<int> status = parseCommandLine(app, words)) return *status;
  return runProgram(app.get_name(), run);
}

}  // namespace pbrtmedia
