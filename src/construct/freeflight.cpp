// SPDX-License-Identifier: BSD-2-Clause
#include "construct/freeflight.h"

#include <string>
#include <string_view>
#include <vector>

#include "construct/tracking_parameters.h"
#include "media/tracking_choice.h"

namespace pbrtmedia {

namespace {

std::string flightsThatServe(const AnyLaw& law, bool walksPieces) {
  std::vector<std::string_view> names = flightNames();
  std::erase_if(names, [&](std::string_view name) {
    const FlightTraits traits = traitsOf(*findFlight(name));
    return !traits.laws.has(law) || (traits.needsPieces && !walksPieces);
  });
  return joinedNames(names);
}

}  // namespace

AnyFlight readFreeFlight(ParamReader& in, const AnyLaw& law, bool walksPieces, bool scatters) {
  AnyFlight flight;
  const std::optional<std::string> name = in.optionalString("freeflight");
  if (std::optional<AnyFlight> found = findFlight(name.value_or("auto"))) {
    flight = *std::move(found);
  } else if (name && *name != "auto") {
    std::vector<std::string_view> names = flightNames();
    names.push_back("auto");
    in.error(ParamKind::String, "freeflight",
             "unknown free-flight sampler \"" + *name + "\"" + suggestion(*name, names));
  }
  if ((!name || *name == "auto") && !traitsOf(flight).laws.has(law)) flight = flightOfAnyLaw(walksPieces);
  readParameters(in, flight);
  const FlightTraits traits = traitsOf(flight);
  if (scatters && !traits.laws.has(law)) {
    std::string text = "the free flights of \"";
    text += nameOf(flight);
    text += "\" follow " + joinedNames(traits.laws.names()) + "; for a medium that scatters, the law \"";
    text += nameOf(law);
    text += "\" is served by " + flightsThatServe(law, walksPieces);
    in.error(ParamKind::String, name ? "freeflight" : "law", text);
  }
  std::string what = "free-flight sampler \"";
  what += nameOf(flight);
  what += '"';
  warnOfBias(in, "freeflight", what, traits.bias, traits.biasNote);
  return flight;
}

}  // namespace pbrtmedia
