// SPDX-License-Identifier: BSD-2-Clause
#include "construct/media.h"

#include <array>

#include "construct/medium_kinds.h"
#include "construct/plugins.h"
#include "scene/param_reader.h"

namespace pbrtmedia {
namespace {

using ReadMedium = std::optional<MediumPlan> (*)(const MediumInput&);

constexpr std::array<Plugin<ReadMedium>, 6> kMedia = {{{"homogeneous", readHomogeneousMedium},
                                                       {"heterogeneous", readHeterogeneousMedium},
                                                       {"nanovdb", readNanoVdbMedium},
                                                       {"perlin", readPerlinMedium},
                                                       {"analytic", readAnalyticMedium},
                                                       {"texture", readTextureMedium}}};

/// Reference 17.1; all others are ours.
constexpr std::array<std::string_view, 12> kPbrtNames = {
    "type", "preset", "sigma_a", "sigma_s", "scale", "g", "nx", "ny", "nz", "density", "p0", "p1"};

}  // namespace

std::optional<MediumPlan> readMedium(MediumDescription& medium, bool isUsed, Diagnostics& diagnostics,
                                     Diagnostics& building) {
  const std::string context = "medium \"" + medium.name + "\"";
  const auto* plugin =
      findPlugin<ReadMedium>(kMedia, medium, context, "it is vacuum, as in PBRT-v3", diagnostics);
  if (plugin == nullptr) return std::nullopt;
  ParamReader in(medium, diagnostics, context);
  in.setPbrtNames({kPbrtNames.begin(), kPbrtNames.end()});
  std::optional<MediumPlan> plan = plugin->read({in, medium, isUsed, building});
  if (!plan) return std::nullopt;  // who stopped early has not asked for all that there is
  in.reportUnused();
  return [plan = std::move(*plan), location = medium.location, context](Textures& textures) {
    return builtAt(location, context, [&] { return plan(textures); });
  };
}

}  // namespace pbrtmedia
