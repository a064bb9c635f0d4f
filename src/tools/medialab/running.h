// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "tools/medialab/problems.h"
#include "tools/medialab/selection.h"
#include "tools/medialab/session.h"

namespace pbrtmedia {

struct RunningOptions {
  LabOptions lab;
  EstimatorSelection selection{.estimators = {"ratio"}};
  FunctionSelection function{.words = {"step-sine"}, .ray = {}, .grid = {}};
  ProblemOptions problem;  ///< the first depth, control and lower control
  double to = 0;           ///< 0: the whole line
  unsigned points = 200, runs = 1000, curves = 100;
};

/// Misso et al. 2023, figures 2 and 3: what an estimator says of the line from its start to s, as s grows,
/// run by run, beside the mean over runs and the answer.
LabTable runningTable(const RunningOptions& options, const StopSignal& stop);

/// `medialab running`.
int runRunning(const RunningOptions& options);

}  // namespace pbrtmedia
