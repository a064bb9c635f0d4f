// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/rng.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"

namespace pbrtmedia {

/// Density at s: counted, and noted where it is above its bound.
template <DensityLine Line>
double boundedLookup(const Line& line, double s, double upper, LookupTally& tally) {
  const double density = line.density(s);
  ++tally.lookups;
  if (density > upper) tally.noteViolation(s, density, upper);
  return density;
}

/// Looks once at a random point of a stretch on which an estimator trusts the bounds alone: an empty one, or
/// one whose lower bound is the upper. So that a wrong bound is noticed; it changes no estimate. Proven
/// bounds cost nothing.
template <DensityLine Line>
void probeTrusted(const Line& line, double sEnter, double sExit, double upper, Rng& rng, LookupTally& tally) {
  if (line.hasProvenBounds()) return;
  boundedLookup(line, sEnter + (sExit - sEnter) * rng.uniformDouble(), upper, tally);
}

}  // namespace pbrtmedia
