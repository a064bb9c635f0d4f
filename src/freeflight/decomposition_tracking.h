// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "fields/density_line.h"
#include "freeflight/flight_query.h"
#include "freeflight/flight_sample.h"
#include "freeflight/flight_traits.h"
#include "freeflight/null_collisions.h"
#include "transmittance/parts/channel_shares.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// Decomposition tracking: the extinction as a control (the super-voxel's lower bound), whose collisions are
/// real without a look at the density, plus the residual above it, tracked with null collisions. Kutz et al.
/// 2017, section 4; weighted where the density leaves its bounds.
///
/// Bias: none, wherever the bounds are positive. Weights: 1 in grey media within bounds. Cost: a share lower
/// / upper of the tentative collisions costs no look-up, in chromatic media too.
struct DecompositionTracking {
  static constexpr std::string_view kName = "decomposition";

  FlightTraits traits() const {
    return {
        .summary =
            "collisions with a known lower bound of the density for free, the residual by null collisions",
        .source = "Kutz et al. 2017, section 4",
        .useWhen = "lower bounds are well above 0 and look-ups are dear",
        .laws = LawSet::mixtures(),
        .unitWeights = true};
  }

  template <DensityLine Line, std::size_t N>
  FlightSample<N> operator()(const Line& line, const FlightQuery<N>& query, SampleStream& stream) const {
    const double sigmaMax = maxOf(query.sigmaT);
    if (!(sigmaMax > 0)) return {.weight = query.importance};
    const Channels<N> share = sharesOf(query.sigmaT, sigmaMax);
    const auto rateOf = [](const auto& bound) { return static_cast<double>(bound.upper); };
    return flyWithNullCollisions<Line, N>(
        line, query, stream, rateOf, [&](double s, const auto& bound, FlightSample<N>& flight) {
          const double upper = bound.upper, lower = std::min(static_cast<double>(bound.lower), upper);
          Channels<N>& weight = flight.weight;
          // The share of the control, before the density is known: real in proportion to what it weighs.
          double all = 0, control = 0;
          for (std::size_t c = 0; c < N; ++c) {
            all += std::abs(weight[c]);
            control += std::abs(weight[c]) * share[c];
          }
          const double known = all > 0 ? control / all * (lower / upper) : 0;
          if (known > 0 && stream.uniform() < known) {
            for (std::size_t c = 0; c < N; ++c) weight[c] *= share[c] * lower / (upper * known);
            return Collision::Real;
          }
          const double density = lookUpAt(line, s, bound, flight);
          for (double& w : weight) w /= 1 - known;
          return chooseEvent(stream.uniform(), density, upper, lower, share, weight);
        });
  }
};

}  // namespace pbrtmedia
