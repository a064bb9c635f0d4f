// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "base/parameters.h"
#include "freeflight/flight_traits.h"

namespace pbrtmedia {

/// One of the free-flight samplers (flights, for short) with its parameters. Knows none of their code, so
/// that who chooses, holds and describes flights does not compile them; freeflight/flight_list.h does. A
/// value: copies share until one is changed.
class AnyFlight {
 public:
  struct Held;

  /// The first of the list.
  AnyFlight();
  /// Of freeflight/flight_list.h.
  template <class Flight>
  requires requires { Flight::kName; }
  AnyFlight(const Flight& flight);
  explicit AnyFlight(std::shared_ptr<const Held> held) : held_(std::move(held)) {}

  const Held& held() const { return *held_; }

 private:
  std::shared_ptr<const Held> held_;
};

/// The keyword of a flight.
std::string_view nameOf(const AnyFlight& flight);
/// The flight called `name`, with its default parameters; nothing when there is none.
std::optional<AnyFlight> findFlight(std::string_view name);
/// All keywords, default first.
std::vector<std::string_view> flightNames();

FlightTraits traitsOf(const AnyFlight& flight);
std::vector<ParameterDescription> parametersOf(const AnyFlight& flight);
AssignResult setParameter(AnyFlight& flight, std::string_view name, const ParameterValue& value);

}  // namespace pbrtmedia
