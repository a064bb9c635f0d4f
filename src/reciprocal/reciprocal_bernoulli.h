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

/// 1/F by Bernoulli trials: points spread by the upper control, each accepted with probability density /
/// control, until the first is; the number of points over the control's integral alpha. Qin et al. 2015,
/// Zeltner et al. 2020; it is the prefix sum of Misso et al. 2022, doi:10.1145/3528223.3530160, Eq. (6), with
/// the roulette on the size of the terms, wherever the control bounds the density.
///
/// Bias: none under a bounding control. Range: >= 1 / alpha. Variance: (1 - p) / F^2, p = F / alpha. Cost:
/// alpha / F look-ups on average, whatever the density.
struct ReciprocalBernoulli {
  static constexpr std::string_view kName = "reciprocal-bernoulli";

  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"maxlookups", &ReciprocalBernoulli::maxLookups, LookupLimit::kSeriesHelp, 0}};
  }
  ReciprocalTraits traits() const {
    return {
        .summary = "the number of rejected and accepted points until the first accepted one",
        .source = "Qin et al. 2015; Zeltner et al. 2020; Misso et al. 2022 (6)",
        .useWhen = "only events are known, not estimates: whether a random process found a solution again",
        .bias = LookupLimit::bias(maxLookups),
        .biasNote = LookupLimit::biasNote(maxLookups),
        .domain = "every density, under a bounding control",
        .control = EstimatorTraits::Control::Bounding,
        .varianceNote = "(1 - F/alpha) / F^2",
        .cost = "alpha / F",
        .costGrowsWithControl = true,
        .boundedCost = maxLookups > 0};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate{.value = filled<N>(kInfinity), .tally = {}};
    ControlledRatio<Line> control(line, 1, Comb::Equidistant, stream, estimate.tally);
    if (!(control.alpha() > 0)) return estimate;
    const LookupLimit limit(mostReciprocalLookups(maxLookups));
    const double reciprocal = trialsReciprocal(
        control.alpha(), [&] { return !(stream.uniform() < control.next()); },
        [&] { return limit.reached(estimate.tally); });
    estimate.value = reciprocalPerChannel(sigmaT, reciprocal);
    return estimate;
  }
};

}  // namespace pbrtmedia
