// SPDX-License-Identifier: BSD-2-Clause
#include "construct/media.h"

#include <array>
#include <filesystem>

#include "construct/phase.h"
#include "construct/plugins.h"
#include "construct/transmittance.h"
#include "media/grid_medium.h"
#include "media/homogeneous.h"
#include "media/nano_vdb_medium.h"
#include "media/presets.h"
#include "scene/param_reader.h"
#include "transmittance/any_estimator.h"

namespace pbrtmedia {
namespace {

using ReadMedium = std::optional<MediumPlan> (*)(ParamReader&, const MediumDescription&);

/// What every medium has: coefficients (preset, explicit, scale), asymmetry, overlap rule.
template <class Params>
void readCommon(ParamReader& in, const MediumDescription& medium, Params& p) {
  p.name = medium.name;
  if (const std::optional<std::string> name = in.optionalString("preset")) {
    if (const std::optional<MediumPreset> preset = findPreset(*name)) {
      p.sigmaA = preset->sigmaA;
      p.sigmaS = preset->sigmaPrimeS;
    } else {
      std::vector<std::string_view> names;
      for (const MediumPreset& known : mediumPresets()) names.push_back(known.name);
      in.diagnostics().lenientError(
          in.locationOf(ParamKind::String, "preset"),
          in.context() + ": unknown preset \"" + *name + "\"" + suggestion(*name, names));
    }
  }
  const float scale = in.findFloat("scale", 1, Range::nonNegative());
  p.sigmaA = in.findSpectrum("sigma_a", p.sigmaA) * scale;
  p.sigmaS = in.findSpectrum("sigma_s", p.sigmaS) * scale;
  for (const auto& [name, sigma] :
       {std::pair<std::string_view, Rgb>{"sigma_a", p.sigmaA}, {"sigma_s", p.sigmaS}}) {
    if (sigma.min() < 0)
      in.error(ParamKind::Spectrum, name, "found a negative coefficient, expected numbers >= 0");
  }
  p.phase = readPhase(in);

  constexpr std::array<std::string_view, 3> kRules = {"boundary", "add", "priority"};
  p.overlap.mode = std::array{OverlapRule::Mode::Boundary, OverlapRule::Mode::Add,
                              OverlapRule::Mode::Priority}[in.findChoice("overlap", kRules, 0)];
  if (const std::optional<int> priority = in.optionalInt("priority")) {
    // A priority alone says which rule is meant.
    if (!in.has(ParamKind::String, "overlap")) p.overlap.mode = OverlapRule::Mode::Priority;
    if (p.overlap.mode != OverlapRule::Mode::Priority) {
      in.error(ParamKind::Integer, "priority", "needs \"string overlap\" \"priority\"");
    }
    p.overlap.priority = *priority;
  }
}

std::optional<MediumPlan> readHomogeneous(ParamReader& in, const MediumDescription& medium) {
  HomogeneousMedium::Params p;
  readCommon(in, medium, p);
  return [p] { return std::make_unique<HomogeneousMedium>(p); };
}

/// What every medium with a density field has beside.
void readFieldMedium(ParamReader& in, const MediumDescription& medium, FieldMediumParams& p) {
  readCommon(in, medium, p);
  p.estimator = readTransmittance(in, p.estimator);
  if (!std::holds_alternative<ExponentialLaw>(lawOf(p.estimator)) && p.sigmaS.max() > 0) {
    in.error(ParamKind::String, "law",
             "free flights follow the exponential law only: under another one the medium must not scatter "
             "(sigma_s 0)");
  }
}

std::optional<MediumPlan> readHeterogeneous(ParamReader& in, const MediumDescription& medium) {
  auto p = std::make_shared<GridMediumParams>();
  readFieldMedium(in, medium, *p);
  const Range size = Range::closed(1, 1 << 20);
  p->grid.nx = in.findInt("nx", 1, size);
  p->grid.ny = in.findInt("ny", 1, size);
  p->grid.nz = in.findInt("nz", 1, size);
  p->grid.p0 = in.findPoint3("p0", p->grid.p0);
  p->grid.p1 = in.findPoint3("p1", p->grid.p1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (p->grid.p0[axis] == p->grid.p1[axis]) {
      in.error(ParamKind::Point3, "p1", "the box is flat: p0 and p1 agree in " + std::string(1, "xyz"[axis]));
      return std::nullopt;
    }
  }
  constexpr std::array<std::string_view, 2> kBorders = {"zero", "clamp"};
  p->grid.border = in.findChoice("border", kBorders, 0) == 0 ? GridBorder::Zero : GridBorder::Clamp;
  if (!in.has(ParamKind::Float, "density")) {
    in.error("parameter \"float density\" is missing");
    return std::nullopt;
  }
  const std::size_t found = in.floats("density").size();
  const std::size_t expected = static_cast<std::size_t>(p->grid.nx) * static_cast<std::size_t>(p->grid.ny) *
                               static_cast<std::size_t>(p->grid.nz);
  if (found != expected) {
    in.error(ParamKind::Float, "density",
             "found " + std::to_string(found) + " values, expected nx*ny*nz = " + std::to_string(p->grid.nx) +
                 "*" + std::to_string(p->grid.ny) + "*" + std::to_string(p->grid.nz) + " = " +
                 std::to_string(expected));
    return std::nullopt;
  }
  p->grid.density = in.takeFloats("density");
  for (std::size_t i = 0; i < expected; ++i) {
    if (p->grid.density[i] >= 0) continue;
    const std::size_t nx = static_cast<std::size_t>(p->grid.nx), ny = static_cast<std::size_t>(p->grid.ny);
    in.error(ParamKind::Float, "density",
             "voxel (" + std::to_string(i % nx) + ", " + std::to_string(i / nx % ny) + ", " +
                 std::to_string(i / (nx * ny)) + ") is negative: " + std::to_string(p->grid.density[i]));
    return std::nullopt;
  }
  return [p, place = medium.ctm->start] {
    auto made = makeGridMedium(*p, place);
    *p = {};  // the input values are not needed any more
    return made;
  };
}

std::optional<MediumPlan> readNanoVdb(ParamReader& in, const MediumDescription& medium) {
  NanoVdbMediumParams p;
  readFieldMedium(in, medium, p);
  p.field.grid = in.findString("grid", "");
  p.field.map.scale = in.findFloat("densityscale", 1, Range::nonNegative());
  p.field.map.offset = in.findFloat("densityoffset", 0);
  const std::optional<std::filesystem::path> file = in.findInputFile("filename");
  if (!file) {
    if (!in.has(ParamKind::String, "filename")) in.error("parameter \"string filename\" is missing");
    return std::nullopt;
  }
  p.field.file = *file;
  // A grid that is not there is told at its name, what is wrong with the file at the file.
  const ParamKind kind = ParamKind::String;
  const SourceLocation named = in.locationOf(kind, in.has(kind, "grid") ? "grid" : "filename");
  return [p = std::move(p), named, context = in.context(), place = medium.ctm->start] {
    return builtAt(named, context, [&] { return makeNanoVdbMedium(p, place); });
  };
}

constexpr std::array<Plugin<ReadMedium>, 3> kMedia = {
    {{"homogeneous", readHomogeneous}, {"heterogeneous", readHeterogeneous}, {"nanovdb", readNanoVdb}}};

}  // namespace

std::optional<MediumPlan> readMedium(MediumDescription& medium, Diagnostics& diagnostics) {
  const std::string context = "medium \"" + medium.name + "\"";
  const auto* plugin = findPlugin<ReadMedium>(kMedia, medium, context, diagnostics);
  if (plugin == nullptr) return std::nullopt;
  ParamReader in(medium, diagnostics, context);
  if (medium.ctm->isAnimated()) {
    diagnostics.warning(medium.location,
                        context + ": media do not move; the transformation of the start time is used");
  }
  if (medium.ctm->start.isSingular()) {
    in.error("the transformation is singular: it has no inverse");
    return std::nullopt;
  }
  std::optional<MediumPlan> plan = plugin->read(in, medium);
  in.reportUnused();
  if (!plan) return std::nullopt;
  return [plan = std::move(*plan), location = medium.location, context] {
    return builtAt(location, context, plan);
  };
}

}  // namespace pbrtmedia
