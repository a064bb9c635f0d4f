// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "fields/density_line.h"
#include "freeflight/flight_query.h"
#include "freeflight/flight_sample.h"
#include "freeflight/mixed_poisson_process.h"
#include "transmittance/parts/bounded_lookup.h"
#include "transmittance/parts/channel_shares.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// What a tentative collision turned out to be.
enum class Collision { Null, Real, Absorbed };

/// The walk of all samplers with null collisions: tentative collisions with the rate `rateOf(bound)` times
/// the largest channel's sigma_t, piecewise constant; `decide(s, bound, flight)` says what each is and
/// updates the weights. Absorbed: the path ends there with weight 0. Under another law that is a mixture of
/// exponential ones they are the points of a MixedPoissonProcess, and all else stays.
template <DensityLine Line, std::size_t N, class RateOf, class Decide>
FlightSample<N> flyWithNullCollisions(const Line& line, const FlightQuery<N>& query, SampleStream& stream,
                                      const RateOf& rateOf, const Decide& decide) {
  FlightSample<N> flight{.weight = query.importance};
  const double sigmaMax = maxOf(query.sigmaT);
  if (!(sigmaMax > 0)) return flight;
  std::optional<MixedPoissonProcess> process;
  if (query.law != nullptr) process.emplace(*query.law, stream);
  // Optical depth of the majorant to the next tentative collision.
  const auto next = [&] { return process ? process->next(stream) : stream.exponential(); };
  double depth = next();
  line.walk([&](double sEnter, double sExit, const auto& bound) {
    if (!(bound.upper > 0)) {
      probeTrusted(line, sEnter, sExit, 0, stream.rng(), flight.tally);
      return true;
    }
    const double rate = sigmaMax * rateOf(bound), inverse = 1 / rate;
    for (double s = sEnter;;) {
      const double depthToExit = (sExit - s) * rate;
      if (depth >= depthToExit) {
        depth -= depthToExit;
        return true;
      }
      s += depth * inverse;
      const Collision collision = decide(s, bound, flight);
      if (collision != Collision::Null) {
        flight.collided = true;
        flight.s = s;
        if (collision == Collision::Absorbed) flight.weight = filled<N>(0);
        return false;
      }
      ++flight.tally.nullCollisions;
      depth = next();
    }
  });
  return flight;
}

/// Looks up the density at a tentative collision and counts what it finds.
template <DensityLine Line, std::size_t N>
double lookUpAt(const Line& line, double s, const auto& bound, FlightSample<N>& flight) {
  return boundedLookup(line, s, bound.upper, flight.tally);
}

/// Chooses real or null for a density under a bound `upper`, in units of the largest channel's sigma_t: real
/// with probability A_r / (A_r + A_n), the sums over the channels of |weight times coefficient|, and updates
/// the weights. Kutz et al. 2017, history-aware average; absolute values where null extinction is negative
/// (Misso et al. 2023). `u` uniform in [0, 1); events of probability 0 are never chosen. `lower`: real
/// extinction below it is dealt with elsewhere.
template <std::size_t N>
Collision chooseEvent(double u, double density, double upper, double lower, const Channels<N>& share,
                      Channels<N>& weight) {
  double real = 0, null = 0;
  for (std::size_t c = 0; c < N; ++c) {
    real += std::abs(weight[c] * share[c] * (density - lower));
    null += std::abs(weight[c] * (upper - share[c] * density));
  }
  const bool isReal = u * (real + null) < real;
  if (!isReal && !(null > 0)) return Collision::Null;  // nothing weighs anything: no event can be told apart
  const double scale = (real + null) / (upper * (isReal ? real : null));
  for (std::size_t c = 0; c < N; ++c) {
    weight[c] *= scale * (isReal ? share[c] * (density - lower) : upper - share[c] * density);
  }
  return isReal ? Collision::Real : Collision::Null;
}

}  // namespace pbrtmedia
