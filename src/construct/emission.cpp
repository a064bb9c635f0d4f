// SPDX-License-Identifier: BSD-2-Clause
#include "construct/emission.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "construct/plugins.h"

namespace pbrtmedia {
namespace {

/// A medium may glow by "Le" or by temperature. Sets the radiance of what temperatures give.
bool usesTemperature(ParamReader& in, bool isGiven, FieldMediumParams& p) {
  if (!isGiven) return false;
  if (in.has(ParamKind::Spectrum, "Le")) {
    in.error(ParamKind::Spectrum, "Le", "the colour comes from temperatures already: one of them");
  }
  const float scale = in.floats("Lescale").size() == 1 ? in.floats("Lescale").front() : 1.0f;
  p.le = Rgb(scale);
  return true;
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
  for (std::size_t i = 0; i < expected; ++i) {
    if (taken.density[i] >= 0) continue;
    const std::size_t nx = static_cast<std::size_t>(grid.nx), ny = static_cast<std::size_t>(grid.ny);
    in.error(ParamKind::Float, name,
             "voxel (" + std::to_string(i % nx) + ", " + std::to_string(i / nx % ny) + ", " +
                 std::to_string(i / (nx * ny)) + ") is negative: " + std::to_string(taken.density[i]));
    return std::nullopt;
  }
  return taken;
}

}  // namespace

void readEmission(ParamReader& in, const MediumDescription& medium, MediumParams& p) {
  p.le = in.findSpectrum("Le", Rgb(0));
  if (p.le.min() < 0) {
    in.error(ParamKind::Spectrum, "Le", "found a negative radiance, expected numbers >= 0");
    p.le = Rgb(0);
  }
  const std::size_t scales = in.floats("Lescale").size();
  if (scales > 1 && medium.type != "heterogeneous") {
    in.error(ParamKind::Float, "Lescale", "found " + std::to_string(scales) + " values, expected 1");
  } else if (scales == 1) {
    const float scale = in.floats("Lescale").front();
    if (!(scale >= 0)) in.error(ParamKind::Float, "Lescale", "found a negative number, expected one >= 0");
    p.le = p.le * scale;
  }
}

EmissionPlan readGridEmission(ParamReader& in, const GridField::Params& grid, FieldMediumParams& p) {
  if (usesTemperature(in, in.has(ParamKind::Float, "temperature"), p)) {
    const TemperatureMap map = readTemperatureMap(in);
    std::optional<GridField::Params> taken = takeGrid(in, "temperature", grid);
    if (!taken) return {};
    return [taken = std::move(*taken), map](const Transform& place) {
      return makeBlackbodyPattern(taken, map, place);
    };
  }
  if (in.floats("Lescale").size() <= 1) return {};
  std::optional<GridField::Params> taken = takeGrid(in, "Lescale", grid);
  if (!taken) return {};
  return [taken = std::move(*taken)](const Transform& place) { return makeScalePattern(taken, place); };
}

EmissionPlan readNanoVdbEmission(ParamReader& in, const NanoVdbField::Params& density, FieldMediumParams& p) {
  const std::optional<std::string> temperatures = in.optionalString("temperaturegrid"),
                                   factors = in.optionalString("Legrid");
  if (!temperatures && !factors) return {};
  const std::string_view name = temperatures ? "temperaturegrid" : "Legrid";
  if (temperatures && factors) {
    in.error(ParamKind::String, "Legrid", "the radiance comes from temperatures already: one of them");
  }
  NanoVdbField::Params grid{.file = density.file, .grid = temperatures ? *temperatures : *factors, .map = {}};
  const SourceLocation named = in.locationOf(ParamKind::String, name);
  if (usesTemperature(in, temperatures.has_value(), p)) {
    const TemperatureMap map = readTemperatureMap(in);
    return [grid = std::move(grid), map, named, context = in.context()](const Transform& place) {
      return builtAt(named, context, [&] { return makeBlackbodyPattern(grid, map, place); });
    };
  }
  return [grid = std::move(grid), named, context = in.context()](const Transform& place) {
    return builtAt(named, context, [&] { return makeScalePattern(grid, place); });
  };
}

}  // namespace pbrtmedia
