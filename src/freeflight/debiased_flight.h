// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "freeflight/flight_query.h"
#include "freeflight/flight_sample.h"
#include "freeflight/flight_traits.h"
#include "transmittance/law.h"
#include "transmittance/parts/bounded_lookup.h"
#include "transmittance/parts/telescoped_march.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// Flights under any law g of a density that can only be looked up: the distance is drawn from a stand-in,
/// and the weight is an unbiased estimate of what a collision there, or having passed, should weigh:
///   collided at s  sigma_t rho(s) (-g'(F(s))) / q(s),  q = sigma_t mu (-p'(M)),
///   passed         g(F) / p(M),                        M = sigma_t times the integral of mu,
/// mu the upper bound, and -g' and g by debiased ray marching (TelescopedMarch) over the way flown: the
/// inversion that MarchedFlight does with a bias, which its weights take away. The stand-in p is the law
/// itself, so that weights are near 1 under tight bounds, and for a tenth of the flights 1 / (1 + M), whose
/// long tail reaches what loose bounds hide. Misso et al. 2022, doi:10.1145/3528223.3530160, name unbiased
/// flights as future work; this is one way. Several channels share distance and marches, the distance by the
/// balance heuristic.
///
/// Bias: none, wherever the bounds are positive. Weights: any, of either sign. The collisions of the linear
/// law end in a jump, whose corrections fall as slowly as their cost rises: their variance is finite only as
/// levels end (TelescopingLevels). Cost: a look-up, and `flightlookups` times 2 r / (2 r - 1) on average.
struct DebiasedFlight {
  static constexpr std::string_view kName = "debiased-ray-marching";

  std::uint64_t lookups = 8;

  static constexpr auto parameters() {
    return std::tuple{Parameter{"flightlookups", &DebiasedFlight::lookups,
                                "look-ups of the coarse march over the way flown", 1,
                                TelescopingLevels::kMostBaseTeeth}};
  }
  FlightTraits traits() const {
    return {
        .summary = "a distance by the bounds, weighted by a debiased estimate of its density under the law",
        .source = "Misso et al. 2022 (14), (22) for the estimate",
        .useWhen = "the law is linear and the density has no cubic pieces",
        .laws = LawSet::all(),
        .mayBeNegative = true};
  }

  template <DensityLine Line, std::size_t N>
  FlightSample<N> operator()(const Line& line, const FlightQuery<N>& query, SampleStream& stream) const {
    FlightSample<N> flight{.weight = query.importance};
    const double sigma = query.sigmaT[N == 1 ? 0 : chooseChannel(query.importance, stream.uniform())];
    const AnyLaw law = query.law != nullptr ? *query.law : AnyLaw{};
    const bool isFar = stream.uniform() < kFarShare;
    const double u = stream.uniformAboveZero(), depth = isFar ? 1 / u - 1 : depthReachedOf(law, u);
    const double reached = sigma > 0 ? depth / sigma : std::numeric_limits<double>::infinity();
    double column = 0, mu = 0;  // of the bound, at the end of the flight
    line.walk([&](double sEnter, double sExit, const auto& bound) {
      mu = static_cast<double>(bound.upper);
      if (!(mu > 0)) {
        probeTrusted(line, sEnter, sExit, 0, stream.rng(), flight.tally);
        return true;
      }
      if (!(column + mu * (sExit - sEnter) > reached)) {
        column += mu * (sExit - sEnter);
        return true;
      }
      flight.collided = true;
      flight.s = std::min(sEnter + (reached - column) / mu, sExit);
      column = reached;
      return false;
    });
    if (!(column > 0) && !flight.collided) return flight;

    double rho = 1, chance = 0;
    if (flight.collided) rho = static_cast<double>(boundedLookup(line, flight.s, mu, flight.tally));
    for (std::size_t c = 0; c < N; ++c) {
      const double standIn = query.sigmaT[c] * column, inverse = 1 / (1 + standIn);
      chance +=
          query.importance[c] / N *
          (flight.collided ? query.sigmaT[c] * mu * mixed(collisionDensityOf(law, standIn), inverse * inverse)
                           : mixed(transmittanceOf(law, standIn), inverse));
    }
    const Channels<N> share = rho > 0 ? estimate(line, law, query, flight, stream) : filled<N>(0);
    for (std::size_t c = 0; c < N; ++c) {
      flight.weight[c] *= (flight.collided ? query.sigmaT[c] * rho : 1) * share[c] / chance;
    }
    return flight;
  }

 private:
  static constexpr double kFarShare = .1;
  static double mixed(double near, double far) { return (1 - kFarShare) * near + kFarShare * far; }

  /// A line that ends earlier.
  template <DensityLine Line>
  class Part {
   public:
    Part(const Line& line, double length) : line_(line), length_(length) {}
    double length() const { return length_; }
    auto density(double s) const { return line_.density(s); }
    void densities(std::span<const double> s, std::span<DensityOf<Line>> out) const {
      line_.densities(s, out);
    }
    template <class Visit>
    void walk(Visit&& visit) const {
      line_.walk([&](double sEnter, double sExit, const auto& bound) {
        return sEnter < length_ && visit(sEnter, std::min(sExit, length_), bound);
      });
    }
    bool hasProvenBounds() const { return line_.hasProvenBounds(); }

   private:
    const Line& line_;
    double length_;
  };

  /// -g' where the flight collided, g where it passed.
  template <DensityLine Line, std::size_t N>
  Channels<N> estimate(const Line& line, const AnyLaw& law, const FlightQuery<N>& query,
                       FlightSample<N>& flight, SampleStream& stream) const {
    const bool jumps = flight.collided && std::holds_alternative<LinearLaw>(law);
    const TelescopedMarch march{
        .n = lookups, .levels = 0, .rate = jumps ? TelescopingLevels::kLeastRate : TelescopingLevels::kRate};
    Channels<N> value = filled<N>(0);
    march.single(Part<Line>(line, flight.collided ? flight.s : line.length()), stream, flight.tally,
                 [&](double column, double factor) {
                   for (std::size_t c = 0; c < N; ++c) {
                     const double depth = query.sigmaT[c] * column;
                     value[c] += factor * (flight.collided ? collisionDensityOf(law, depth)
                                                           : transmittanceOf(law, depth));
                   }
                 });
    return value;
  }
};

}  // namespace pbrtmedia
