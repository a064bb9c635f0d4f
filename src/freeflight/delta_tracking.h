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

/// Delta tracking: tentative collisions with the rate of the local majorant, real with probability sigma_t
/// rho / majorant. Woodcock et al. 1965; in chromatic media as WeightedDeltaTracking does it. A density above
/// its bound counts as the bound, and as a violation: the classical method, for comparisons.
///
/// Bias: none under a bounding control. Weights: 1 in grey media, at most N in chromatic ones.
struct DeltaTracking {
  static constexpr std::string_view kName = "delta";

  FlightTraits traits() const {
    return {
        .summary = "tentative collisions at the rate of the bound, each real in proportion to the density",
        .source = "Woodcock et al. 1965; Kutz et al. 2017",
        .useWhen = "bounds are proven, or classical results are to be reproduced",
        .control = EstimatorTraits::Control::Bounding,
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
          const double upper = bound.upper, u = stream.uniform();
          if constexpr (N == 1) {
            if (line.hasProvenBounds() && u * upper < static_cast<double>(bound.lower))
              return Collision::Real;
          }
          const double density = std::min(lookUpAt(line, s, bound, flight), upper);
          if constexpr (N == 1) return u * upper < density ? Collision::Real : Collision::Null;
          return chooseEvent(u, density, upper, 0, share, flight.weight);
        });
  }
};

}  // namespace pbrtmedia
