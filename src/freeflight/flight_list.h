// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>

#include "freeflight/any_flight.h"
#include "freeflight/debiased_flight.h"
#include "freeflight/decomposition_tracking.h"
#include "freeflight/delta_tracking.h"
#include "freeflight/marched_flight.h"
#include "freeflight/regular_flight.h"
#include "freeflight/single_particle_tracking.h"
#include "freeflight/weighted_delta_tracking.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// The one list of free-flight samplers. A new one is its header and one word here. The first is the default.
///
/// A flight is a small immutable value: kName, traits(), parameters() (base/parameters.h), and
///   template <DensityLine Line, std::size_t N>
///   FlightSample<N> operator()(const Line& line, const FlightQuery<N>& query, SampleStream& stream) const;
/// whose weights are those of the flight times the importance of the channels. Every decision is one
/// dimension of the stream.
using FlightVariant = std::variant<WeightedDeltaTracking, DeltaTracking, DecompositionTracking,
                                   SingleParticleTracking, DebiasedFlight, MarchedFlight, RegularFlight>;

struct AnyFlight::Held {
  FlightVariant variant;
};

template <class Flight>
requires requires { Flight::kName; }
AnyFlight::AnyFlight(const Flight& flight)
    : held_(std::make_shared<const Held>(Held{FlightVariant(flight)})) {}

/// Calls `f` with the concrete flight.
template <class F>
decltype(auto) visitFlight(F&& f, const AnyFlight& flight) {
  return std::visit(std::forward<F>(f), flight.held().variant);
}

/// A flight by any of them. A channel that counts nothing is not asked for: its weight is 0. One whose traits
/// say needsPieces must not be asked on a line without: std::logic_error.
template <class Flight, class Line, std::size_t N>
FlightSample<N> flyOn(const Flight& flight, const Line& line, const FlightQuery<N>& query,
                      SampleStream& stream) {
  if constexpr (requires { flight(line, query, stream); }) {
    FlightSample<N> sample = flight(line, query, stream);
    sample.weight = withoutImportance(query, sample.weight);
    return sample;
  } else {
    throw std::logic_error("this free flight needs a line in cubic pieces");
  }
}

}  // namespace pbrtmedia
