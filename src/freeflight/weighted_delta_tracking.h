// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
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

/// Weighted delta tracking: tentative collisions with the rate of the local majorant, real with probability
/// sigma_t rho / majorant as in delta tracking (Woodcock et al. 1965). Where a density exceeds its bound,
/// null extinction is negative; probabilities then take absolute values and the weights the sign: unbiased,
/// but with weights beyond N. Galtier et al. 2013; Misso et al. 2023, section 3. Grey media under a bound
/// keep weight 1, and a collision that the cell's lower bound already makes real costs no look-up.
///
/// Chromatic media follow the spectral tracking of Kutz et al. 2017, doi:10.1145/3072959.3073665, with the
/// history-aware average: the largest channel's majorant drives the process, and a tentative collision is
/// real with probability A_r / (A_r + A_n), A_r and A_n being the sums over the channels of weight times real
/// and of weight times null extinction. As real and null add up to the majorant, the mean weight of the
/// channels stays 1, so no weight exceeds N.
///
/// Bias: none, wherever the bounds are positive. Events of probability 0 are never chosen.
struct WeightedDeltaTracking {
  static constexpr std::string_view kName = "weighted-delta";

  FlightTraits traits() const {
    return {
        .summary =
            "tentative collisions at the rate of the bound; null extinction may be negative, with weights",
        .source = "Woodcock et al. 1965; Kutz et al. 2017; Misso et al. 2023",
        .useWhen = "always: under a bound it is delta tracking, under a wrong one it stays unbiased",
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
          // A collision that is real for certain needs proof.
          const double upper = bound.upper;
          const double lower = line.hasProvenBounds() ? static_cast<double>(bound.lower) : 0;
          const double u = stream.uniform();
          if constexpr (N == 1) {
            if (u * upper < lower) return Collision::Real;
          }
          const double density = lookUpAt(line, s, bound, flight);
          if constexpr (N == 1) {
            if (density <= upper) return u * upper < density ? Collision::Real : Collision::Null;
            // What lies below the lower bound was dealt with above; of the rest, null extinction is negative.
            const double known = lower / upper;
            flight.weight[0] /= 1 - known;
            return chooseEvent((u - known) / (1 - known), density, upper, lower, share, flight.weight);
          }
          return chooseEvent(u, density, upper, 0, share, flight.weight);
        });
  }
};

}  // namespace pbrtmedia
