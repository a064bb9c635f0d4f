// SPDX-License-Identifier: BSD-2-Clause
#include "construct/media.h"

#include <array>

#include "construct/medium_kinds.h"
#include "construct/plugins.h"
#include "scene/param_reader.h"

namespace pbrtmedia {
namespace {

using ReadMedium = std::optional<MediumPlan> (*)(ParamReader&, const MediumDescription&);

constexpr std::array<Plugin<ReadMedium>, 6> kMedia = {{{"homogeneous", readHomogeneousMedium},
                                                       {"heterogeneous", readHeterogeneousMedium},
                                                       {"nanovdb", readNanoVdbMedium},
                                                       {"perlin", readPerlinMedium},
                                                       {"analytic", readAnalyticMedium},
                                                       {"texture", readTextureMedium}}};

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
  return [plan = std::move(*plan), location = medium.location, context](Textures& textures) {
    return builtAt(location, context, [&] { return plan(textures); });
  };
}

}  // namespace pbrtmedia
