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

/// Johnson's estimator: (1 - 1/n)^S, S being the number of real collisions of n walks by delta tracking that
/// do not stop at them. S is Poisson distributed with mean n tau, and of all unbiased functions of S this one
/// varies least. Johnson 1951; Kettunen et al. 2021, Eq. (6). Deviation: the n walks are one of n times the
/// rate, which has the same collisions. n = 1 is track-length. One number decides for all channels at a
/// collision, so each channel alone is this estimator.
///
/// Bias: none under a bound; where the density exceeds it too little is absorbed. Range: [0, 1]. Variance:
/// T^2 expm1(tau / n), whatever the bound. Cost: n times the optical depth of the majorant; for n = 1 less,
/// as the walk ends at a real collision.
struct Johnson {
  static constexpr std::string_view kName = "johnson";

  std::uint32_t n = 4;           ///< walks, >= 1
  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{
        Parameter{"n", &Johnson::n, "number of walks: cost grows with it, variance falls", 1, 1e6},
        Parameter{"maxlookups", &Johnson::maxLookups, LookupLimit::kWalkHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "(1 - 1/n) to the number of real collisions of n walks",
            .source = "Johnson 1951; Kettunen et al. 2021 (6)",
            .useWhen = "only real collisions can be counted; otherwise ratio tracking does more with them",
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
    const double keep = 1 - 1 / static_cast<double>(n);
    PoissonWalk walk(stream);
    line.walk([&](double sEnter, double sExit, const auto& bound) {
      const double upper = bound.upper;
      if (!(upper > 0)) {
        probeTrusted(line, sEnter, sExit, 0, stream.rng(), tally);
        return true;
      }
      return walk.cross(sEnter, sExit, n * sigmaMax * upper, [&](double s) {
        if (limit.reached(tally)) return false;
        const double ratio = boundedLookup(line, s, upper, tally) / upper;
        return passCollision(estimate.value, share, ratio, keep, stream, tally);  // Eq. (6)
      });
    });
    return estimate;
  }
};

}  // namespace pbrtmedia
