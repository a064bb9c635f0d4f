// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>

#include "tools/medialab/problems.h"
#include "tools/medialab/selection.h"
#include "tools/medialab/session.h"

namespace pbrtmedia {

struct ProfileOptions {
  LabOptions lab;
  EstimatorSelection selection;  ///< one estimator or more
  FunctionSelection function{.words = {"cosine"}, .ray = {}, .grid = {}};
  ProblemOptions problem;  ///< the first of each list counts
  unsigned points = 256;   ///< where the field is shown
  std::string picture;     ///< image file to plot into; empty: none
};

/// `medialab profile`. One line: the extinction and its controls along it (kind "field"), and where one
/// estimate of each estimator looked, in the order of its look-ups (kind: the estimator). Extinctions in 1 /
/// length.
int runProfile(const ProfileOptions& options);

}  // namespace pbrtmedia
