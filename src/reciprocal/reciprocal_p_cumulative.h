// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/math.h"
#include "base/parameters.h"
#include "reciprocal/controlled_ratio.h"
#include "reciprocal/geometric_series.h"
#include "reciprocal/per_channel.h"
#include "reciprocal/reciprocal_traits.h"
#include "transmittance/parts/lookup_limit.h"

namespace pbrtmedia {

/// 1/F as the series 1/alpha sum_j (1 - F/alpha)^j about the control's integral alpha, term by term, ended by
/// a roulette on the term's own size as p-series cumulative estimation of transmittance is. Misso et al.
/// 2022, doi:10.1145/3528223.3530160, Eq. (6); Georgiev et al. 2019, Eq. (30). Each factor is the mean over
/// `n` look-ups.
///
/// Bias: none where E|1 - F_i/alpha| < 1 for the estimates F_i of n look-ups, so always under a bounding
/// control; and under one that is too low, as long as F < 2 alpha and n is large enough. Variance: under a
/// bounding control (1 - F/alpha) / F^2 for every n, that of Bernoulli trials; finite beyond where E[(1 -
/// F_i/alpha)^2] < 1. Cost: n alpha / F look-ups on average under a bounding control: then n > 1 buys
/// nothing.
struct ReciprocalPCumulative {
  static constexpr std::string_view kName = "reciprocal-p-cumulative";

  std::uint64_t n = 1;
  Comb comb = Comb::Equidistant;
  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    using Self = ReciprocalPCumulative;
    return std::tuple{Parameter{"n", &Self::n, kReciprocalCountHelp, 1, 4096},
                      Parameter{"comb", &Self::comb, kReciprocalCombHelp},
                      Parameter{"maxlookups", &Self::maxLookups, LookupLimit::kSeriesHelp, 0}};
  }
  ReciprocalTraits traits() const {
    return {.summary =
                "the geometric series about the control term by term, ended by a roulette on the term's size",
            .source = "Misso et al. 2022 (6); Georgiev et al. 2019 (30)",
            .useWhen = "nothing is known of the density, or its bound may be too low by less than a half",
            .bias = LookupLimit::bias(maxLookups),
            .biasNote = LookupLimit::biasNote(maxLookups),
            .domain = "every density under a bounding control; beyond where E abs(1 - F_i/alpha) < 1",
            .control = EstimatorTraits::Control::Any,
            .varianceNote =
                "(1 - F/alpha) / F^2; under one that is too low, finite where E (1 - F_i/alpha)^2 < 1",
            .seriesLimit = 1,
            .cost = "n alpha / F under a bounding control",
            .costGrowsWithControl = true,
            .boundedCost = maxLookups > 0};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate{.value = filled<N>(kInfinity), .tally = {}};
    ControlledRatio<Line> control(line, n, comb, stream, estimate.tally);
    if (!(control.alpha() > 0)) return estimate;
    const LookupLimit limit(mostReciprocalLookups(maxLookups));
    const double reciprocal = cumulativeReciprocal(
        control.alpha(), stream, [&] { return control.next(); },
        [&] { return limit.reached(estimate.tally); });
    estimate.value = reciprocalPerChannel(sigmaT, reciprocal);
    return estimate;
  }
};

}  // namespace pbrtmedia
