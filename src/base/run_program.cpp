// SPDX-License-Identifier: BSD-2-Clause
#include "base/run_program.h"

#include <exception>
#include <iostream>
#include <new>

#include "base/diagnostics.h"
#include "base/interruption.h"

namespace pbrtmedia {

int runProgram(const std::string& name, const std::function<int()>& run) {
  const auto reportError = [&](const std::string& where, const std::string& what) {
    std::cerr << name << ": " << where << (where.empty() ? "" : ": ") << "error: " << what << '\n';
    return 1;
  };
  try {
    const int status = run();
    std::cout.flush();
    if (!std::cout) return reportError("", "cannot write to standard output");
    return status;
  } catch (const SceneError& e) {
    return reportError(e.location().toString(), e.what());
  } catch (const Interrupted& e) {
    return reportError("", "stopped: " + e.reason());
  } catch (const std::bad_alloc&) {
    return reportError("", "not enough memory");
  } catch (const std::exception& e) {
    return reportError("", e.what());
  }
}

}  // namespace pbrtmedia
