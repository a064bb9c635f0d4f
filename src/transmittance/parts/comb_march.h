// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/bound_profile.h"
#include "transmittance/parts/comb_integrator.h"
#include "transmittance/parts/comb_size.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// The frame of the estimators of deterministic cost: a number of teeth, then a value from one or more combs.
/// 1 without a look-up where there is no extinction or no length, or vacuum is proven.
struct CombMarch {
  static constexpr std::string_view kTeethHelp =
      "look-ups of one comb; 0: what p-series CMF spends on average";
  static constexpr std::string_view kLimitHelp =
      "most look-ups of one comb, 0: no limit; wider spaced teeth, more bias, and counted";

  CombSettings comb;
  std::uint64_t mostTeeth = 0;

  /// `teethUnder(depth)`: teeth wanted under a control (majorant minus minorant) of this optical depth in the
  /// largest channel. `valueFrom(combs)`: the estimate per channel, from a CombIntegrator.
  template <DensityLine Line, std::size_t N, class TeethUnder, class ValueFrom>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream,
                         const TeethUnder& teethUnder, const ValueFrom& valueFrom) const {
    Estimate<N> estimate;
    const double sigmaMax = maxOf(sigmaT);
    if (!(sigmaMax > 0)) return estimate;
    const BoundProfile profile(line);
    if (!(profile.length() > 0) || (line.hasProvenBounds() && !(profile.upper() > 0))) return estimate;
    const double wanted = teethUnder(sigmaMax * profile.excess());
    const std::uint64_t teeth = teethOf(wanted, mostTeeth);
    if (mostTeeth > 0 && teeth < teethOf(wanted, 0)) estimate.tally.capped = 1;
    CombIntegrator<Line> combs(line, profile, comb, teeth, !line.hasProvenBounds(), stream, estimate.tally);
    estimate.value = valueFrom(combs);
    return estimate;
  }
};

}  // namespace pbrtmedia
