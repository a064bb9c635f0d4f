// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "transmittance/parts/bound_profile.h"
#include "transmittance/parts/bounded_lookup.h"
#include "transmittance/parts/channel_products.h"
#include "transmittance/parts/channel_shares.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/poisson.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// Residual ratio tracking as a power series: first the number k of collisions, Poisson distributed with mean
/// tau_bar - tau_c, then k points in any order with a density proportional to majorant - minorant. The same
/// distribution as residual ratio tracking, with k and each point a dimension of its own. Georgiev et al.
/// 2019, section 5.1.
///
/// Bias, range, variance, exact stretches: those of ResidualRatioTracking. Cost: tau_bar - tau_c on average
/// at most; points behind a product of exactly 0 are not looked at.
struct PSeriesResidual {
  static constexpr std::string_view kName = "p-series-residual";

  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"maxlookups", &PSeriesResidual::maxLookups, LookupLimit::kWalkHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "residual ratio tracking with the number of collisions drawn first, in any order",
            .source = "Georgiev et al. 2019, section 5.1",
            .useWhen = "residual ratio tracking fits and the estimates of a pixel share a sampling pattern",
            .bias = LookupLimit::bias(maxLookups),
            .biasNote = LookupLimit::biasNote(maxLookups),
            .mayLeaveUnitInterval = false,
            .control = EstimatorTraits::Control::Any,
            .boundedCost = maxLookups > 0};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    const double sigmaMax = maxOf(sigmaT);
    if (!(sigmaMax > 0)) return estimate;
    const Channels<N> share = sharesOf(sigmaT, sigmaMax);
    LookupTally& tally = estimate.tally;
    const BoundProfile profile(line);
    for (const BoundPiece& piece : profile.pieces()) {
      if (piece.upper > piece.lower) continue;
      probeTrusted(line, piece.sEnter, piece.sExit, piece.upper, stream.rng(), tally);
    }
    const double excess = profile.excess(), mean = sigmaMax * excess;
    const LookupLimit limit(maxLookups);
    ChannelProducts<N> weight;
    std::uint64_t k = mean > 0 ? poissonQuantile(stream.uniform(), mean) : 0;
    for (; k > 0 && !weight.isZero(); --k) {
      if (limit.reached(tally)) break;
      const auto [s, piece] = profile.place(BoundProfile::Weight::Excess, stream.uniform() * excess);
      const double ratio =
          (boundedLookup(line, s, piece->upper, tally) - piece->lower) / (piece->upper - piece->lower);
      ++tally.nullCollisions;
      weight.multiply(nullShares(share, ratio));
    }
    estimate.value = weight.attenuated(sigmaT, profile.lower());
    return estimate;
  }
};

}  // namespace pbrtmedia
