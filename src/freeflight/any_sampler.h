// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <stdexcept>
#include <string_view>
#include <variant>
#include <vector>

#include "freeflight/decomposition_tracking.h"
#include "freeflight/delta_tracking.h"
#include "freeflight/marched_flight.h"
#include "freeflight/regular_flight.h"
#include "freeflight/sampler_traits.h"
#include "freeflight/single_particle_tracking.h"
#include "freeflight/weighted_delta_tracking.h"
#include "transmittance/parameters.h"

namespace pbrtmedia {

/// The one list of free-flight samplers. A new one is its header and one word here. The first is the default.
///
/// A sampler is a small immutable value: kName, traits(), parameters() (transmittance/parameters.h), and
///   template <DensityLine Line, std::size_t N>
///   FlightSample<N> operator()(const Line& line, const FlightQuery<N>& query, Rng& rng) const;
/// whose weights are those of the flight times the importance of the channels.
using AnySampler = std::variant<WeightedDeltaTracking, DeltaTracking, DecompositionTracking,
                                SingleParticleTracking, MarchedFlight, RegularFlight>;

/// The keyword of a sampler.
std::string_view nameOf(const AnySampler& sampler);
/// The sampler called `name`, with its default parameters; nothing when there is none.
std::optional<AnySampler> findSampler(std::string_view name);
/// All keywords, default first.
std::vector<std::string_view> samplerNames();

SamplerTraits traitsOf(const AnySampler& sampler);
std::vector<ParameterDescription> parametersOf(const AnySampler& sampler);
AssignResult setParameter(AnySampler& sampler, std::string_view name, const ParameterValue& value);

/// A flight by any sampler. A channel that counts nothing is not asked for: its weight is 0. One whose traits
/// say needsPieces must not be asked on a line without: std::logic_error.
template <class Sampler, class Line, std::size_t N>
FlightSample<N> fly(const Sampler& sampler, const Line& line, const FlightQuery<N>& query, Rng& rng) {
  if constexpr (requires { sampler(line, query, rng); }) {
    FlightSample<N> flight = sampler(line, query, rng);
    flight.weight = withoutImportance(query, flight.weight);
    return flight;
  } else {
    throw std::logic_error("this sampler needs a line in cubic pieces");
  }
}

}  // namespace pbrtmedia
