// SPDX-License-Identifier: BSD-2-Clause
#include "freeflight/any_flight.h"

#include "base/variant_names.h"
#include "freeflight/flight_list.h"

namespace pbrtmedia {
namespace {

AnyFlight holding(FlightVariant variant) {
  return AnyFlight(std::make_shared<const AnyFlight::Held>(AnyFlight::Held{std::move(variant)}));
}

}  // namespace

AnyFlight::AnyFlight() : held_(std::make_shared<const Held>()) {}

std::string_view nameOf(const AnyFlight& flight) { return alternativeName(flight.held().variant); }
std::optional<AnyFlight> findFlight(std::string_view name) {
  auto found = findAlternative<FlightVariant>(name);
  if (!found) return std::nullopt;
  return holding(*std::move(found));
}
std::vector<std::string_view> flightNames() { return alternativeNames<FlightVariant>(); }

FlightTraits traitsOf(const AnyFlight& flight) {
  return visitFlight([](const auto& held) { return held.traits(); }, flight);
}
std::vector<ParameterDescription> parametersOf(const AnyFlight& flight) {
  return visitFlight([](const auto& held) { return describeParameters(held); }, flight);
}
AssignResult setParameter(AnyFlight& flight, std::string_view name, const ParameterValue& value) {
  FlightVariant changed = flight.held().variant;
  AssignResult result = std::visit([&](auto& held) { return assignParameter(held, name, value); }, changed);
  flight = holding(std::move(changed));
  return result;
}

}  // namespace pbrtmedia
