// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "tools/medialab/command_options.h"
#include "tools/medialab/levels.h"
#include "tools/medialab/power_law.h"
#include "tools/medialab/progressive.h"
#include "tools/medialab/running.h"

namespace pbrtmedia {

/// The commands that show how estimators work inside, each with its options; they live as long as the
/// program.
class LineCommands {
 public:
  void addTo(CLI::App& app, const Words& words, Run& run);

 private:
  LevelsOptions levels_;
  RunningOptions running_;
  PowerLawOptions powerLaw_;
  ProgressiveOptions progressive_;
};

}  // namespace pbrtmedia
