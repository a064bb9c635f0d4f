// SPDX-License-Identifier: BSD-2-Clause
#include "construct/material_kinds.h"
#include "materials/disney.h"

namespace pbrtmedia {

Materials::Make readDisney(Texturable& in) {
  const auto color = in.findRgb("color", Rgb(0.5f)), distance = in.findRgb("scatterdistance", Rgb(0));
  const auto metallic = in.findFloat("metallic", 0), eta = in.findFloat("eta", 1.5f, Range::positive());
  const auto roughness = in.findFloat("roughness", 0.5f);
  const auto specularTint = in.findFloat("speculartint", 0), anisotropic = in.findFloat("anisotropic", 0);
  const auto sheen = in.findFloat("sheen", 0), sheenTint = in.findFloat("sheentint", 0.5f);
  const auto clearcoat = in.findFloat("clearcoat", 0), gloss = in.findFloat("clearcoatgloss", 1);
  const auto specTrans = in.findFloat("spectrans", 0);
  const bool isThin = in.findBool("thin", false);
  const auto flatness = in.findFloat("flatness", 0), diffTrans = in.findFloat("difftrans", 1);
  const auto bump = in.optionalFloat("bumpmap");
  const bool goesBelow = !isThin && !(distance.isConstant() && distance.constant.nonNegative().isBlack());
  if (goesBelow && eta.isConstant()) warnOfIndexBelowSurface(in, eta.constant);
  return [=](Materials& m) {
    Textures& t = m.textures();
    return std::make_unique<DisneyMaterial>(DisneyParams{.color = t.rgbTexture(color),
                                                         .metallic = t.floatTexture(metallic),
                                                         .eta = t.floatTexture(eta),
                                                         .roughness = t.floatTexture(roughness),
                                                         .specularTint = t.floatTexture(specularTint),
                                                         .anisotropic = t.floatTexture(anisotropic),
                                                         .sheen = t.floatTexture(sheen),
                                                         .sheenTint = t.floatTexture(sheenTint),
                                                         .clearcoat = t.floatTexture(clearcoat),
                                                         .clearcoatGloss = t.floatTexture(gloss),
                                                         .specTrans = t.floatTexture(specTrans),
                                                         .scatterDistance = t.rgbTexture(distance),
                                                         .isThin = isThin,
                                                         .flatness = t.floatTexture(flatness),
                                                         .diffTrans = t.floatTexture(diffTrans),
                                                         .bumpMap = t.floatTexture(bump)});
  };
}

}  // namespace pbrtmedia
