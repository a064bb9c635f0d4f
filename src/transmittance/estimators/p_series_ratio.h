// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "transmittance/parts/channel_products.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/poisson.h"
#include "transmittance/parts/upper_control.h"

namespace pbrtmedia {

/// Ratio tracking as a power series: first the number k of collisions, Poisson distributed with the optical
/// depth tau_bar of the majorant, then k points in any order with density majorant / tau_bar, and the product
/// of 1 - sigma_t rho(x_i) / majorant over them. The same distribution as ratio tracking, with k and each
/// point a dimension of its own, which stratifies better. Georgiev et al. 2019, section 5.1.
///
/// Bias: none, wherever the bounds are positive. Range: [0, 1] while bounds hold. Variance in one channel:
/// T^2 expm1(integral of mu^2 / majorant). Cost: tau_bar on average at most; points behind a product of
/// exactly 0 are not looked at.
struct PSeriesRatio {
  static constexpr std::string_view kName = "p-series-ratio";

  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"maxlookups", &PSeriesRatio::maxLookups, LookupLimit::kWalkHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "ratio tracking with the number of collisions drawn first and their order ignored",
            .source = "Georgiev et al. 2019, section 5.1",
            .useWhen = "ratio tracking fits and the estimates of a pixel share a sampling pattern",
            .bias = LookupLimit::bias(maxLookups),
            .biasNote = LookupLimit::biasNote(maxLookups),
            .mayLeaveUnitInterval = false,
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
    for (std::uint64_t k = poissonQuantile(stream.uniform(), depth); k > 0 && !weight.isZero(); --k) {
      if (limit.reached(estimate.tally)) break;
      weight.multiply(control.nullRatio(stream.uniform() * depth));
      ++estimate.tally.nullCollisions;
    }
    for (std::size_t c = 0; c < N; ++c) estimate.value[c] = weight[c].product();
    return estimate;
  }
};

}  // namespace pbrtmedia
