// SPDX-License-Identifier: BSD-2-Clause
#include <glog/logging.h>

#include <exception>
#include <iostream>
#include <new>

#include "base/diagnostics.h"
#include "main/options.h"
#include "main/render.h"

int main(int argc, char** argv) {
  using namespace pbrtmedia;
  const OptionsOutcome outcome = readOptions(argc, argv);
  if (!outcome.options) return outcome.exitStatus;
  google::InitGoogleLogging(argv[0]);
  try {
    return runPbrt(*outcome.options);
  } catch (const SceneError& e) {
    Diagnostics diagnostics;
    diagnostics.add(e);
    std::cerr << diagnostics.format();
  } catch (const std::bad_alloc&) {
    std::cerr << "pbrt: error: out of memory\n";
  } catch (const std::exception& e) {
    std::cerr << "pbrt: error: " << e.what() << '\n';
  }
  return 1;
}
