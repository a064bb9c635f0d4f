// SPDX-License-Identifier: BSD-2-Clause
#include "construct/emission.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "construct/plugins.h"
#include "construct/tolerance.h"
#include "construct/volume_file.h"

namespace pbrtmedia {
namespace {

/// A medium of sigma_a 0 emits nothing, whatever else is said.
void warnIfNothingEmits(ParamReader& in, const SourceLocation& at, const MediumParams& p) {
  if (p.le.isBlack() || !p.sigmaA.isBlack()) return;
  in.diagnostics().warning(at, in.context() +
                                   ": sigma_a is 0, and what a medium emits is sigma_a times its "
                                   "radiance, so it emits nothing");
}

/// Whether "Lescale" has something to multiply: "Le", or temperatures.
bool hasRadiance(const ParamReader& in) {
  const ParamList& params = in.entity().params;
  return params.find(ParamKind::Spectrum, "Le") != nullptr ||
         params.find(ParamKind::Float, "temperature") != nullptr ||
         params.find(ParamKind::String, "temperaturegrid") != nullptr;
}

void requireRadiance(ParamReader& in, ParamKind kind, std::string_view name) {
  if (hasRadiance(in)) return;
  in.error(
      kind, name,
      "it multiplies the radiance \"Le\", which is not given, so that the medium would emit nothing; add "
      "\"rgb Le\" [ 1 1 1 ]");
}

/// A medium may glow by "Le" or by temperature. Sets the radiance of what temperatures give.
bool usesTemperature(ParamReader& in, ParamKind kind, std::string_view name, bool isGiven,
                     FieldMediumParams& p) {
  if (!isGiven) return false;
  if (in.has(ParamKind::Spectrum, "Le")) {
    in.error(ParamKind::Spectrum, "Le", "the colour comes from temperatures already: one of them");
  }
  const float scale = in.floats("Lescale").size() == 1 ? in.floats("Lescale").front() : 1.0f;
  p.le = Rgb(scale);
  warnIfNothingEmits(in, in.locationOf(kind, name), p);
  return true;
}

/// Says so where a grid leaves a medium dark that was meant to glow.
std::shared_ptr<const EmissionPattern> toldIfBlack(std::shared_ptr<const EmissionPattern> pattern,
                                                   std::string_view why, const SourceLocation& named,
                                                   std::string_view context, Diagnostics& diagnostics) {
  if (pattern->isBlack()) {
    diagnostics.warning(named, std::string(context) + ": the medium emits nothing: " + std::string(why));
  }
  return pattern;
}

constexpr std::string_view kTooCold =
    "no temperature is above 100 K, below which all is dark; is a \"float temperaturescale\" missing?";
constexpr std::string_view kNoFactor = "all its factors are 0";

/// What maps temperatures means nothing without them.
void refuseTemperatureMap(ParamReader& in, std::string_view needed) {
  for (const std::string_view name : {"temperaturescale", "temperatureoffset"}) {
    if (in.has(ParamKind::Float, name))
      in.error(ParamKind::Float, name, "needs " + std::string(needed) + ", which is not given");
  }
}

TemperatureMap readTemperatureMap(ParamReader& in) {
  TemperatureMap map;
  map.scale = in.findFloat("temperaturescale", map.scale, Range::nonNegative());
  map.offset = in.findFloat("temperatureoffset", map.offset);
  return map;
}

/// As many numbers as the grid has samples, each >= 0. Nothing after an error.
std::optional<GridField::Params> takeGrid(ParamReader& in, std::string_view name,
                                          const GridField::Params& grid) {
  const std::size_t found = in.floats(name).size();
  const std::size_t expected = static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny) *
                               static_cast<std::size_t>(grid.nz);
  if (found != expected) {
    std::string text = "found " + std::to_string(found) + " values, expected ";
    text += name == "Lescale" ? "1 or nx*ny*nz = " : "nx*ny*nz = ";
    text += std::to_string(expected);
    in.error(ParamKind::Float, name, text);
    return std::nullopt;
  }
  GridField::Params taken;
  taken.nx = grid.nx;
  taken.ny = grid.ny;
  taken.nz = grid.nz;
  taken.p0 = grid.p0;
  taken.p1 = grid.p1;
  taken.border = grid.border;
  taken.density = in.takeFloats(name);
  clampNegatives(taken.density, grid.nx, grid.ny, "parameter \"" + std::string(name) + '"',
                 in.locationOf(ParamKind::Float, name), in.context(), in.diagnostics());
  return taken;
}

/// Of two plans the one that is there, or both multiplied.
EmissionPlan productOf(EmissionPlan a, EmissionPlan b) {
  if (!a) return b;
  if (!b) return a;
  return [a = std::move(a), b = std::move(b)](const Transform& place) {
    return makeProductPattern(a(place), b(place));
  };
}

}  // namespace

void readEmission(ParamReader& in, const MediumDescription& medium, MediumParams& p) {
  p.le = nonNegative(in, "Le", in.findSpectrum("Le", Rgb(0)));
  const std::size_t scales = in.floats("Lescale").size();
  if (scales > 1 && medium.type != "heterogeneous") {
    in.error(ParamKind::Float, "Lescale", "found " + std::to_string(scales) + " values, expected 1");
  } else if (scales > 0) {
    requireRadiance(in, ParamKind::Float, "Lescale");
  }
  if (scales == 1) {
    const float scale = in.floats("Lescale").front();
    if (!(scale >= 0)) in.error(ParamKind::Float, "Lescale", "found a negative number, expected one >= 0");
    p.le = p.le * scale;
  }
  warnIfNothingEmits(in, in.locationOf(ParamKind::Spectrum, "Le"), p);
}

EmissionPlan readGridEmission(const MediumInput& input, const GridField::Params& grid, FieldMediumParams& p) {
  ParamReader& in = input.in;
  Diagnostics& building = input.building;
  constexpr ParamKind kKind = ParamKind::Float;
  EmissionPlan temperatures, factors;
  if (usesTemperature(in, kKind, "temperature", in.has(kKind, "temperature"), p)) {
    const TemperatureMap map = readTemperatureMap(in);
    if (std::optional<GridField::Params> taken = takeGrid(in, "temperature", grid)) {
      temperatures = [taken = *std::move(taken), map, named = in.locationOf(kKind, "temperature"),
                      context = in.context(), &building](const Transform& place) {
        return toldIfBlack(makeBlackbodyPattern(taken, map, place), kTooCold, named, context, building);
      };
    }
  } else {
    refuseTemperatureMap(in, "\"float temperature\"");
  }
  if (in.floats("Lescale").size() > 1) {
    if (std::optional<GridField::Params> taken = takeGrid(in, "Lescale", grid)) {
      factors = [taken = *std::move(taken), named = in.locationOf(kKind, "Lescale"), context = in.context(),
                 &building](const Transform& place) {
        return toldIfBlack(makeScalePattern(taken, place), kNoFactor, named, context, building);
      };
    }
  }
  return productOf(std::move(temperatures), std::move(factors));
}

EmissionPlan readNanoVdbEmission(const MediumInput& input, const std::filesystem::path& file,
                                 FieldMediumParams& p) {
  ParamReader& in = input.in;
  constexpr ParamKind kKind = ParamKind::String;
  const auto gridNamed = [&](std::string_view parameter, std::string_view whyBlack,
                             const auto& make) -> EmissionPlan {
    const std::optional<std::string> name = in.optionalString(parameter);
    if (!name) return {};
    return [make, whyBlack, grid = NanoVdbField::Params{.file = file, .grid = *name, .map = {}},
            named = in.locationOf(kKind, parameter), context = in.context(),
            &building = input.building](const Transform& place) {
      return builtAt(named, context, [&] {
        NegativeDensities negatives;
        NanoVdbField::Params params = grid;
        params.map.negatives = &negatives;
        std::shared_ptr<const EmissionPattern> pattern = make(params, place);
        tellNegatives(negatives, grid.grid, named, context, building);
        return toldIfBlack(std::move(pattern), whyBlack, named, context, building);
      });
    };
  };
  EmissionPlan temperatures;
  if (usesTemperature(in, kKind, "temperaturegrid", in.has(kKind, "temperaturegrid"), p)) {
    const TemperatureMap map = readTemperatureMap(in);
    temperatures = gridNamed("temperaturegrid", kTooCold, [map](const auto& grid, const Transform& place) {
      return makeBlackbodyPattern(grid, map, place);
    });
  } else {
    refuseTemperatureMap(in, "\"string temperaturegrid\"");
  }
  EmissionPlan factors = gridNamed("Legrid", kNoFactor, [](const auto& grid, const Transform& place) {
    return makeScalePattern(grid, place);
  });
  if (factors) requireRadiance(in, kKind, "Legrid");
  return productOf(std::move(temperatures), std::move(factors));
}

}  // namespace pbrtmedia
