// SPDX-License-Identifier: BSD-2-Clause
#include "construct/medium_kinds.h"
#include "construct/medium_params.h"
#include "construct/texturable.h"
#include "construct/textures.h"
#include "media/procedural_medium.h"
#include "media/texture_density.h"

namespace pbrtmedia {

std::optional<MediumPlan> readTextureMedium(ParamReader& in, const MediumDescription& medium) {
  ProceduralMediumParams p;
  p.bounds.source = BoundsParams::Source::Progressive;
  readFieldMediumParams(in, medium, DensityKind::Procedural, p);
  const auto use = Texturable(in, medium.scope).optionalFloat("density", Range::nonNegative());
  if (!use) {
    if (!in.has(ParamKind::Texture, "density") && !in.has(ParamKind::Float, "density"))
      in.error("parameter \"texture density\" is missing: the name of a float texture");
    return std::nullopt;
  }
  if (p.bounds.source == BoundsParams::Source::Exact) {
    in.error(ParamKind::String, "bounds",
             "a texture knows no bounds of its own: expected \"progressive\", or \"constant\" with a "
             "\"float majorant\"");
  }
  if (!readMediumBox(in, p.field.p0, p.field.p1)) return std::nullopt;
  const std::string name = in.findTextureName("density").value_or("");
  return [p, use = *use, name, place = medium.ctm->start](Textures& textures) mutable {
    p.field.function = std::make_shared<TextureDensity>(*textures.floatTexture(use), name, place);
    return makeProceduralMedium(p, "texture", place);
  };
}

}  // namespace pbrtmedia
