// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/rng.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/bounded_lookup.h"

namespace pbrtmedia {

/// Whether all bounds of the line are 0, or it has no length: its transmittance is 1. Stops at the first
/// positive bound; where the bounds are unproven each stretch of vacuum is probed once.
template <DensityLine Line>
bool isVacuum(const Line& line, Rng& rng, LookupTally& tally) {
  bool vacuum = true;
  line.walk([&](double, double, const auto& bound) { return vacuum = !(bound.upper > 0); });
  if (vacuum && !line.hasProvenBounds()) {
    line.walk([&](double sEnter, double sExit, const auto&) {
      probeTrusted(line, sEnter, sExit, 0, rng, tally);
      return true;
    });
  }
  return vacuum;
}

}  // namespace pbrtmedia
