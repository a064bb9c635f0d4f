// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/medialab/problems.h"
#include "tools/medialab/selection.h"
#include "tools/medialab/session.h"

namespace pbrtmedia {

struct ConvergeOptions {
  LabOptions lab;
  EstimatorSelection selection;
  FunctionSelection functions{.words = {"cosine"}, .ray = {}, .grid = {}};
  ProblemOptions problem;
  PatternKind pattern = PatternKind::Independent;
  unsigned doublings = 10;     ///< means of 1, 2, 4, ... 2^doublings estimates
  std::uint64_t trials = 256;  ///< means of each size
};

/// The root mean square error of the mean of n estimates against n, against its look-ups and its seconds,
/// and the slopes of straight lines fitted in logarithms, which each row of a curve repeats. Each n has
/// trials of its own, so the points of a curve are independent.
LabTable convergeTable(const ConvergeOptions& options, const StopSignal& stop);

/// `medialab converge`.
int runConverge(const ConvergeOptions& options);

}  // namespace pbrtmedia
