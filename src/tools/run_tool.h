// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "base/run_program.h"

namespace pbrtmedia {

/// The body of a tool's main: parses the command line, then does `run`, which a command's callback may have
/// stored meanwhile, as runProgram. A wrong command line gives status 1.
inline int runTool(CLI::App& app, int argc, char** argv, const std::function<int()>& run) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 1;
  }
  return runProgram(app.get_name(), run);
}

}  // namespace pbrtmedia
