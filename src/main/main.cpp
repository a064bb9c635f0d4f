// SPDX-License-Identifier: BSD-2-Clause
#include <glog/logging.h>

#include <iostream>

#include "base/diagnostics.h"
#include "base/run_program.h"
#include "main/options.h"
#include "main/render.h"

int main(int argc, char** argv) {
  using namespace pbrtmedia;
  const OptionsOutcome outcome = readOptions(argc, argv);
  if (!outcome.options) return outcome.exitStatus;
  google::InitGoogleLogging(argv[0]);
  return runProgram("pbrt", [&] {
    try {
      return runPbrt(*outcome.options);
    } catch (const SceneError& e) {  // shown with its excerpt, as those that were collected
      if (e.location().file == nullptr) throw;
      Diagnostics diagnostics;
      diagnostics.add(e);
      std::cerr << diagnostics.format();
      return 1;
    }
  });
}
