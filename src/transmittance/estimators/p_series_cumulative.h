// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "transmittance/parts/channel_products.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/term_roulette.h"
#include "transmittance/parts/upper_control.h"

namespace pbrtmedia {

/// P-series cumulative estimation: terms of the power series e^{-tau_bar} sum_k tau_n^k / k!, each from the
/// one before by one more independent point of density proportional to the majorant,
///   W_k = W_{k-1} tau_bar (mu_n / majorant)(x_k) / k,
/// continued with probability P = min(|W_k|, 1) and then divided by it. Georgiev et al. 2019, Eq. (30); here
/// with piecewise constant majorants, one weight per channel, and P from the largest |W_k| of the channels.
/// The look-up before the termination counts as cost. Every order takes two dimensions of a pattern, its
/// point and its roulette, the second also where it is not needed, so that dimensions keep their meaning.
///
/// Bias: none, wherever the bounds are positive. Range: any sign, and above 1. Variance: finite for any
/// positive bounds, the lowest of its kind where they are too low; grows like e^{2 (integral |mu_n| -
/// tau_bar)} there. Cost: above 1 look-up, near tau_bar where that is below 1; about the k where tau_n^k / k!
/// falls below 1, that is up to e tau_n.
struct PSeriesCumulative {
  static constexpr std::string_view kName = "p-series-cumulative";

  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"maxlookups", &PSeriesCumulative::maxLookups, LookupLimit::kSeriesHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "the power series term by term, ended by a roulette on the term's own size",
            .source = "Georgiev et al. 2019 (30)",
            .useWhen = "bounds may be too low, or the medium is thick and look-ups should follow it",
            .bias = LookupLimit::bias(maxLookups),
            .biasNote = LookupLimit::biasNote(maxLookups),
            .mayLeaveUnitInterval = true,
            .control = EstimatorTraits::Control::Any,
            .boundedCost = maxLookups > 0};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    UpperControl<Line, N> control(line, sigmaT, stream, estimate.tally);
    const double depth = control.depth();
    if (!(depth > 0)) return estimate;
    const LookupLimit limit(maxLookups);
    ChannelProducts<N> weight(-depth);
    estimate.value = filled<N>(0);
    weight.addTo(estimate.value);
    for (double k = 1; !limit.reached(estimate.tally); ++k) {
      weight.multiply(control.nullRatio(stream.uniform() * depth), depth / k);
      const double survival = survivalFactor(weight.magnitude(), stream);
      if (!(survival > 0)) break;
      if (survival > 1) weight.multiply(survival);
      weight.addTo(estimate.value);
    }
    return estimate;
  }
};

}  // namespace pbrtmedia
