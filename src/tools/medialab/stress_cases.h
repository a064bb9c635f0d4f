// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <vector>

#include "fields/canonical_function.h"
#include "fields/canonical_line.h"

namespace pbrtmedia {

/// A stiff or extreme line.
struct StressCase {
  std::string name;
  CanonicalFunction function;
  double depth = 1;  ///< optical depth
  CanonicalLine::Setup setup;
  bool isQuick = true;        ///< belongs to the quick form
  bool isBlind = false;       ///< a bound of 0 hides density
  double sigmaOfNothing = 0;  ///< extinction where the density integrates to 0
};

/// All cases: depths, controls, contrasts, jumps, spikes, holes, fractals, denormal densities, lengths,
/// offsets, nothing at all, and bounds of 0 over density.
std::vector<StressCase> stressCases();
/// Those of estimators of 1/F: F from 1e-100 to 1e100, near 1 and near the control's integral, controls that
/// are loose, too low or 0, densities that are 0 somewhere or all but 0, units, and nothing at all.
std::vector<StressCase> reciprocalStressCases();

}  // namespace pbrtmedia
