// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <exception>
#include <functional>
#include <iostream>
#include <new>
#include <string>

#include "base/diagnostics.h"

namespace pbrtmedia {

/// The body of a tool's main: parses the command line, does what the chosen command stored in `run`, and
/// turns whatever went wrong into one line "name: place: error: what" and status 1.
inline int runTool(CLI::App& app, int argc, char** argv, const std::function<int()>& run) {
  const auto reportError = [&](const std::string& where, const std::string& what) {
    std::cerr << app.get_name() << ": " << where << (where.empty() ? "" : ": ") << "error: " << what << '\n';
    return 1;
  };
  try {
    app.parse(argc, argv);
    const int status = run();
    std::cout.flush();
    if (!std::cout) return reportError("", "cannot write to standard output");
    return status;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 1;
  } catch (const SceneError& e) {
    return reportError(e.location().toString(), e.what());
  } catch (const std::bad_alloc&) {
    return reportError("", "not enough memory");
  } catch (const std::exception& e) {
    return reportError("", e.what());
  }
}

}  // namespace pbrtmedia
