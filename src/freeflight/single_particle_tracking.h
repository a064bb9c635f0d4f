// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "freeflight/flight_query.h"
#include "freeflight/flight_sample.h"
#include "freeflight/flight_traits.h"
#include "freeflight/null_collisions.h"
#include "transmittance/parts/channel_shares.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// When the single particle may be absorbed.
enum class ParticleModel {
  Terminating,     ///< scatter a r, transmit |1 - r|, else absorbed
  NonTerminating,  ///< both divided by their sum: never absorbed, the weight carries it
  Adaptive         ///< terminating, unless r < 1 or the sum exceeds 1
};
template <>
inline constexpr std::array kChoices<ParticleModel>{
    std::string_view("terminating"), std::string_view("nonterminating"), std::string_view("adaptive")};

/// The single-particle model of Szirmay-Kalos et al. 2017: tentative collisions with a sampling extinction
/// sigma_samp = `boundscale` times the bound, which need not bound. With r = sigma_t / sigma_samp and albedo
/// a the particle that scatters weighs a r, the one that transmits 1 - r, possibly negative; one of them is
/// followed, with probabilities q_s and q_t, or none. Several channels: probabilities by the mean over
/// channels.
///
/// Bias: none, wherever the bounds are positive. Absorbed flights end with weight 0, so emission must not be
/// found by flights. Weights grow where r > 2 / (a + 1).
struct SingleParticleTracking {
  static constexpr std::string_view kName = "single-particle";

  ParticleModel model = ParticleModel::Adaptive;
  double boundScale = 1;

  static constexpr auto parameters() {
    using Self = SingleParticleTracking;
    return std::tuple{
        Parameter{"model", &Self::model, "whether a particle may be absorbed at a tentative collision"},
        Parameter{"boundscale", &Self::boundScale,
                  "sampling extinction as a multiple of the bound; below 1 fewer "
                  "look-ups, weights that may be negative",
                  0.01, 100}};
  }
  FlightTraits traits() const {
    return {.summary =
                "tentative collisions at any rate; the particle scatters, transmits or is absorbed, weighted",
            .source = "Szirmay-Kalos et al. 2017, section 4",
            .useWhen =
                "bounds are unknown or loose, and single peaks above the sampling extinction are tolerable",
            .laws = LawSet::mixtures()};
  }

  template <DensityLine Line, std::size_t N>
  FlightSample<N> operator()(const Line& line, const FlightQuery<N>& query, SampleStream& stream) const {
    const double sigmaMax = maxOf(query.sigmaT);
    if (!(sigmaMax > 0)) return {.weight = query.importance};
    const Channels<N> share = sharesOf(query.sigmaT, sigmaMax);
    const auto rateOf = [&](const auto& bound) { return boundScale * static_cast<double>(bound.upper); };
    return flyWithNullCollisions<Line, N>(
        line, query, stream, rateOf, [&](double s, const auto& bound, FlightSample<N>& flight) {
          const double density = lookUpAt(line, s, bound, flight), sampling = rateOf(bound);
          Channels<N>& weight = flight.weight;
          Channels<N> r;
          double all = 0, scatter = 0, transmit = 0, ratio = 0;
          for (std::size_t c = 0; c < N; ++c) {
            r[c] = share[c] * density / sampling;
            all += std::abs(weight[c]);
            scatter += std::abs(weight[c]) * query.albedo[c] * r[c];
            transmit += std::abs(weight[c] * (1 - r[c]));
            ratio += std::abs(weight[c]) * r[c];
          }
          // A weight of 0 has nothing left to follow.
          if (!(all > 0)) return Collision::Absorbed;
          const double sum = scatter + transmit;
          const bool terminates = model != ParticleModel::NonTerminating && sum <= all &&
                                  (model == ParticleModel::Terminating || ratio >= all);
          const double whole = terminates ? all : sum;
          const double u = stream.uniform() * whole;
          if (u < scatter) {
            for (std::size_t c = 0; c < N; ++c) weight[c] *= r[c] * whole / scatter;
            return Collision::Real;
          }
          if (!(u < sum) || !(transmit > 0)) return Collision::Absorbed;
          for (std::size_t c = 0; c < N; ++c) weight[c] *= (1 - r[c]) * whole / transmit;
          return Collision::Null;
        });
  }
};

}  // namespace pbrtmedia
