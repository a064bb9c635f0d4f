// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "transmittance/parts/channel_products.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/upper_control.h"

namespace pbrtmedia {

/// Next-flight estimation: a walk from a whose rate is the majorant; every point on it adds the chance to fly
/// on to b without a further collision,
///   T = e^{-tau_bar(a,b)} + sum_i e^{-tau_bar(x_i,b)} prod_{j<=i} mu_n(x_j) / majorant(x_j).
/// Cramer 1978; Georgiev et al. 2019, Eq. (7); here with piecewise constant majorants and one weight per
/// channel, the largest channel driving the walk.
///
/// Bias: none, wherever the bounds are positive. Range: >= 0 while bounds hold, and may exceed 1. Second
/// moment in one channel: A(a) + integral (mu_n^2 / majorant) A(x) exp(-2 tau(a,x) + integral_a^x mu^2 /
/// majorant) dx, A = 2 q T(x,b) - q^2, q = e^{-tau_bar(x,b)}; finite for any positive bounds. Cost: tau_bar
/// look-ups on average, less where the weights reach exactly 0.
struct NextFlight {
  static constexpr std::string_view kName = "next-flight";

  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"maxlookups", &NextFlight::maxLookups, LookupLimit::kSeriesHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "at every point of one walk, the chance to fly on to the end",
            .source = "Cramer 1978; Georgiev et al. 2019 (7)",
            .useWhen = "bounds are tight, above all where the extinction grows along the line",
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
    ChannelProducts<N> weight;
    estimate.value = filled<N>(0);
    weight.addTo(estimate.value, -depth);
    for (double x = stream.exponential(); x < depth; x += stream.exponential()) {
      if (limit.reached(estimate.tally)) break;
      weight.multiply(control.nullRatio(x));
      ++estimate.tally.nullCollisions;
      weight.addTo(estimate.value, x - depth);
      if (weight.magnitude() == 0) break;
    }
    return estimate;
  }
};

}  // namespace pbrtmedia
