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

}  // namespace pbrtmedia
