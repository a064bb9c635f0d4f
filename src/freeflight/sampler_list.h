// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>

#include "freeflight/any_sampler.h"
#include "freeflight/decomposition_tracking.h"
#include "freeflight/delta_tracking.h"
#include "freeflight/marched_flight.h"
#include "freeflight/regular_flight.h"
#include "freeflight/single_particle_tracking.h"
#include "freeflight/weighted_delta_tracking.h"

namespace pbrtmedia {

/// The one list of free-flight samplers. A new one is its header and one word here. The first is the default.
///
/// A sampler is a small immutable value: kName, traits(), parameters() (base/parameters.h), and
///   template <DensityLine Line, std::size_t N>
///   FlightSample<N> operator()(const Line& line, const FlightQuery<N>& query, Rng& rng) const;
/// whose weights are those of the flight times the importance of the channels.
using SamplerVariant = std::variant<WeightedDeltaTracking, DeltaTracking, DecompositionTracking,
                                    SingleParticleTracking, MarchedFlight, RegularFlight>;

struct AnySampler::Held {
  SamplerVariant variant;
};

template <class Sampler>
requires requires { Sampler::kName; }
AnySampler::AnySampler(const Sampler& sampler)
    : held_(std::make_shared<const Held>(Held{SamplerVariant(sampler)})) {}

/// Calls `f` with the concrete sampler.
template <class F>
decltype(auto) visitSampler(F&& f, const AnySampler& sampler) {
  return std::visit(std::forward<F>(f), sampler.held().variant);
}

/// A flight by any sampler. A channel that counts nothing is not asked for: its weight is 0. One whose traits
/// say needsPieces must not be asked on a line without: std::logic_error.
template <class Sampler, class Line, std::size_t N>
FlightSample<N> flyOn(const Sampler& sampler, const Line& line, const FlightQuery<N>& query, Rng& rng) {
  if constexpr (requires { sampler(line, query, rng); }) {
    FlightSample<N> flight = sampler(line, query, rng);
    flight.weight = withoutImportance(query, flight.weight);
    return flight;
  } else {
    throw std::logic_error("this sampler needs a line in cubic pieces");
  }
}

}  // namespace pbrtmedia
