// SPDX-License-Identifier: BSD-2-Clause
#include "construct/medium_kinds.h"
#include "construct/medium_params.h"
#include "construct/texturable.h"
#include "construct/textures.h"
#include "media/procedural_medium.h"
#include "media/texture_density.h"

namespace pbrtmedia {

std::optional<MediumPlan> readTextureMedium(const MediumInput& input) {
  ParamReader& in = input.in;
  const MediumDescription& medium = input.medium;
  ProceduralMediumParams p;
  p.bounds.source = BoundsParams::Source::Progressive;
  readFieldMediumParams(in, medium, DensityKind::Procedural, p);
  // A parameter of ours: where PBRT-v3 has a default for textures, here the subject would be missing.
  const std::string name = in.findTextureName("density").value_or("");
  const auto use = Texturable(in, medium.scope).optionalFloat("density", Range::nonNegative());
  if (!use || (name.empty() && in.has(ParamKind::Texture, "density"))) {
    in.error("parameter \"texture density\": expected the name of a float texture that is defined");
    return std::nullopt;
  }
  if (p.bounds.source == BoundsParams::Source::Exact) {
    in.error(ParamKind::String, "bounds",
             "a texture knows no bounds of its own: expected \"progressive\", or \"constant\" with a "
             "\"float majorant\"");
  }
  if (!readMediumBox(in, p.field.p0, p.field.p1)) return std::nullopt;
  return [p, use = *use, name, place = medium.ctm->start](Textures& textures) mutable {
    if (!use.isConstant() && textures.isUnusable(use.texture)) {
      throw SceneError(SourceLocation{},
                       "the texture \"" + name + "\" of its density has no values of its own");
    }
    p.field.function = std::make_shared<TextureDensity>(*textures.floatTexture(use), name, place);
    return makeProceduralMedium(p, "texture", place);
  };
}

}  // namespace pbrtmedia
