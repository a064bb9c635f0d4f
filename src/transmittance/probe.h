// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/rng.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"

namespace pbrtmedia {

/// Looks once at a random point of a stretch whose unproven bound says 0, so that a wrong one is noticed. It
/// changes no estimate: without a majorant there is no process to weigh.
template <DensityLine Line>
void probeEmpty(const Line& line, double sEnter, double sExit, Rng& rng, LookupTally& tally) {
  const double s = sEnter + (sExit - sEnter) * rng.uniformDouble(), density = line.density(s);
  ++tally.lookups;
  if (density > 0) tally.noteViolation(s, density, 0);
}

}  // namespace pbrtmedia
