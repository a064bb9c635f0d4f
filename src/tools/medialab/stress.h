// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/medialab/selection.h"
#include "tools/medialab/session.h"

namespace pbrtmedia {

struct StressOptions {
  LabOptions lab;
  EstimatorSelection selection;
  std::vector<std::string> cases;  ///< names, or beginnings of names; empty: all
  bool isQuick = false;
};

/// Every estimator on every case of its quantity (stress_cases.h), each cell in a process of its own, with a
/// verdict.
LabTable stressTable(const StressOptions& options, const StopSignal& stop);

/// `medialab stress`. 1 when any verdict is "fail", or missing because the run was stopped.
int runStress(const StressOptions& options);

}  // namespace pbrtmedia
