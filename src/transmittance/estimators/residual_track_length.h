// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
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

/// Residual track-length estimator: the lower bounds of the super-voxels are integrated, delta tracking sees
/// what is left above them. exp(-sigma_t integral of lower) if every tentative collision of the rate sigma_t
/// (upper - lower) is null, which each is with probability 1 - (rho - lower) / (upper - lower); else 0.
/// Georgiev et al. 2019, Eqs. (4) and (6) joined. Stretches with upper = lower are exact and cost nothing;
/// unproven ones are probed once. Channels as in TrackLength.
///
/// Bias: none while lower <= rho <= upper; else too much or too little is absorbed. Values: 0 and
/// exp(-tau_c). Variance: T exp(-tau_c) - T^2. Cost: integral of (majorant - mu_c) exp(-(tau - tau_c)(0, x)).
struct ResidualTrackLength {
  static constexpr std::string_view kName = "residual-track-length";

  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"maxlookups", &ResidualTrackLength::maxLookups, LookupLimit::kWalkHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "minorants integrated, delta tracking on what is left above them",
            .source = "Georgiev et al. 2019 (4), (6)",
            .useWhen = "minorants are close to the density and what is left is opaque",
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
    double minorant = 0;  // integral of the lower bounds
    bool anyAlive = true;
    PoissonWalk walk(stream);
    line.walk([&](double sEnter, double sExit, const auto& bound) {
      const double upper = bound.upper, lower = bound.lower, excess = upper - lower;
      minorant += (sExit - sEnter) * lower;
      if (!(excess > 0)) {
        probeTrusted(line, sEnter, sExit, upper, stream.rng(), tally);
        return true;
      }
      if (tally.capped != 0) return true;
      walk.cross(sEnter, sExit, sigmaMax * excess, [&](double s) {
        if (limit.reached(tally)) return false;
        const double density = boundedLookup(line, s, upper, tally);
        if (density < lower) tally.noteViolation(s, density, lower);
        const double ratio = (density - lower) / excess;
        anyAlive = passCollision(estimate.value, share, ratio, 0, stream, tally);
        return anyAlive;
      });
      return anyAlive;
    });
    for (std::size_t c = 0; c < N; ++c) {
      if (estimate.value[c] > 0) estimate.value[c] = std::exp(-sigmaT[c] * minorant);
    }
    return estimate;
  }
};

}  // namespace pbrtmedia
