// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/bounded_lookup.h"
#include "transmittance/parts/channel_shares.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/poisson_walk.h"
#include "transmittance/parts/real_collision.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Track-length estimator, also known as delta or Woodcock tracking: 1 if every tentative collision of one
/// walk is null, which each is with probability 1 - sigma_t rho / majorant; else 0. Woodcock et al. 1965;
/// Georgiev et al. 2019, Eq. (4). Here with piecewise constant majorants; one number decides for all channels
/// at a collision, so each channel alone is this estimator, and the walk ends with the last of them.
///
/// Bias: none under a bound; where the density exceeds it too little is absorbed. Values: 0 and 1. Variance:
/// T - T^2, whatever the bound. Cost: integral of majorant exp(-tau(0, x)) look-ups, which is majorant depth
/// times (1 - T) / tau when the bound is proportional to the density.
struct TrackLength {
  static constexpr std::string_view kName = "track-length";

  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"maxlookups", &TrackLength::maxLookups, LookupLimit::kWalkHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "whether one walk by delta tracking meets no real collision: 0 or 1",
            .source = "Woodcock et al. 1965; Georgiev et al. 2019 (4)",
            .useWhen = "as the baseline, or where the medium is opaque and walks end early",
            .bias = LookupLimit::bias(maxLookups),
            .biasNote = LookupLimit::biasNote(maxLookups),
            .mayLeaveUnitInterval = false,
            .control = EstimatorTraits::Control::Bounding,
            .boundedCost = maxLookups > 0};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    const double sigmaMax = maxOf(sigmaT);
    if (!(sigmaMax > 0)) return estimate;
    const Channels<N> share = sharesOf(sigmaT, sigmaMax);
    LookupTally& tally = estimate.tally;
    const LookupLimit limit(maxLookups);
    PoissonWalk walk(stream);
    line.walk([&](double sEnter, double sExit, const auto& bound) {
      const double upper = bound.upper;
      if (!(upper > 0)) {
        probeTrusted(line, sEnter, sExit, 0, stream.rng(), tally);
        return true;
      }
      return walk.cross(sEnter, sExit, sigmaMax * upper, [&](double s) {
        if (limit.reached(tally)) return false;
        const double ratio = boundedLookup(line, s, upper, tally) / upper;
        return passCollision(estimate.value, share, ratio, 0, stream, tally);
      });
    });
    return estimate;
  }
};

}  // namespace pbrtmedia
