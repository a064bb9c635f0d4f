// SPDX-License-Identifier: BSD-2-Clause
#include <glog/logging.h>

#include "main/options.h"
#include "main/render.h"
#include "main/together.h"
#include "render/ranks.h"

int main(int argc, char** argv) {
  using namespace pbrtmedia;
  const OptionsOutcome outcome = readOptions(argc, argv);
  if (!outcome.options) return outcome.exitStatus;
  google::InitGoogleLogging(argv[0]);
  Together alone(oneRank());
  return runPbrtProgram(*outcome.options, alone);
}
