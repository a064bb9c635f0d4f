// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

#include "tools/medialab/problems.h"
#include "tools/medialab/selection.h"
#include "tools/medialab/session.h"

namespace pbrtmedia {

/// What becomes of upper controls between passes.
enum class BoundsUpdate {
  Learned,  ///< max(control, density found + epsilon), interval by interval
  Rising    ///< control + rise, up to a largest one
};

struct ProgressiveOptions {
  LabOptions lab;
  EstimatorSelection selection{.estimators = {"ratio"}};
  FunctionSelection function{.words = {"composite-sine"}, .ray = {}, .grid = {}};
  ProblemOptions problem{.superVoxels = 80};  ///< its controls do not matter
  unsigned passes = 64, perPass = 1, repeats = 256;
  // All of these are extinctions.
  double start = 0.01;  ///< control before the first pass
  BoundsUpdate update = BoundsUpdate::Learned;
  double epsilon = 0.2, rise = 0.5, most = 20;
  bool isUnclamped = false;
};

/// Progressive null tracking on a line: Misso et al. 2023, figures 6, 8 and 10. A row for each pass: how many
/// intervals are bounded and how deep the control is, and mean and mean square error of the average of all
/// passes so far.
LabTable progressiveTable(const ProgressiveOptions& options, const StopSignal& stop);

/// `medialab progressive`.
int runProgressive(const ProgressiveOptions& options);

}  // namespace pbrtmedia
