// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

#include "tools/medialab/problems.h"
#include "tools/medialab/selection.h"
#include "tools/medialab/session.h"

namespace pbrtmedia {

struct LevelsOptions {
  static constexpr unsigned kMostLevels = 20;

  LabOptions lab;
  EstimatorSelection selection{.estimators = {"debiased-ray-marching"}};
  FunctionSelection functions{.words = {"cosine"}, .ray = {}, .grid = {}};
  ProblemOptions problem;
  unsigned levels = 8;
  std::uint64_t trials = 10000;  ///< of each row
};

/// Misso et al. 2022, figure 7: mean, variance and cost of the corrections Delta_j of estimators that
/// telescope over ever finer marches, with marches of neighbouring levels split from one set of points, and
/// with independent ones.
LabTable levelsTable(const LevelsOptions& options, const StopSignal& stop);

/// `medialab levels`.
int runLevels(const LevelsOptions& options);

}  // namespace pbrtmedia
