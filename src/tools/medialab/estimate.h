// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/medialab/problems.h"
#include "tools/medialab/selection.h"
#include "tools/medialab/session.h"

namespace pbrtmedia {

struct EstimateOptions {
  LabOptions lab;
  EstimatorSelection selection;
  FunctionSelection functions{.words = {"all"}, .ray = {}, .grid = {}};
  ProblemOptions problem;
  TrialPlan plan;
  /// Columns of what was chosen; the law also where one is not exponential.
  bool showLaw = false, showPattern = false, showLower = false;
  std::uint64_t trials = 10000;
};

/// Trials of every estimator on every problem: a row each with mean, variance, cost and their product, which
/// is the inverse of efficiency. Columns speak of one trial, the mean of `plan.samples` estimates.
LabTable estimateTable(EstimateOptions options, const StopSignal& stop);

/// `medialab estimate`.
int runEstimate(const EstimateOptions& options);

}  // namespace pbrtmedia
