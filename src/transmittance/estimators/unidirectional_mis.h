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
#include "transmittance/parts/upper_control.h"

namespace pbrtmedia {

/// Unidirectional multiple importance sampling: ratio tracking and next-flight estimation on one walk from a,
/// joined by the balance heuristic. With q_i = e^{-tau_bar(x_i,b)}, x_0 = a and R_i = prod_{j<=i} mu_n(x_j) /
/// majorant(x_j) every point scores R_i q_i / (1 + q_i), and so does the last one once more for having
/// reached b. Georgiev et al. 2019, section 5.4; here with piecewise constant majorants and one weight per
/// channel.
///
/// Bias: none, wherever the bounds are positive. Range: >= 0 while bounds hold, and may exceed 1. Second
/// moment in one channel: that of NextFlight with A = h^2 (1 + 3q) + 2h (T(x,b) - q), h = q / (1 + q); finite
/// for any positive bounds. Cost: tau_bar look-ups on average, less where the weights reach exactly 0.
struct UnidirectionalMis {
  static constexpr std::string_view kName = "unidirectional-mis";

  std::uint64_t maxLookups = 0;  ///< see LookupLimit

  static constexpr auto parameters() {
    return std::tuple{Parameter{"maxlookups", &UnidirectionalMis::maxLookups, LookupLimit::kSeriesHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {
        .summary = "ratio tracking and next-flight estimation on one walk, weighted by how likely each is",
        .source = "Georgiev et al. 2019, section 5.4",
        .useWhen =
            "bounds are tight and the medium thin, above all where the extinction grows along the line",
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
    for (double last = 0;;) {
      const double rest = last - depth;  // -tau_bar(x_i, b)
      const double half = 1 / (1 + std::exp(rest));
      weight.addTo(estimate.value, rest, half);
      const double x = last + stream.exponential();
      if (x >= depth) {
        weight.addTo(estimate.value, rest, half);
        return estimate;
      }
      if (limit.reached(estimate.tally)) return estimate;
      weight.multiply(control.nullRatio(x));
      ++estimate.tally.nullCollisions;
      if (weight.magnitude() == 0) return estimate;
      last = x;
    }
  }
};

}  // namespace pbrtmedia
