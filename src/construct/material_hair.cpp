// SPDX-License-Identifier: BSD-2-Clause
#include "construct/material_kinds.h"
#include "construct/tolerance.h"
#include "materials/hair.h"

namespace pbrtmedia {
namespace {

constexpr float kUsualEumelanin = 1.3f;  // of brown hair

}  // namespace

Materials::Make readHair(Texturable& in) {
  const auto sigmaA = in.optionalRgb("sigma_a"), color = in.optionalRgb("color");
  auto eumelanin = in.optionalFloat("eumelanin"), pheomelanin = in.optionalFloat("pheomelanin");
  const auto ignored = [&](std::string_view name, std::string_view winner) {
    in.own().diagnostics().warning(in.own().entity().location,
                                   in.own().context() + ": parameter \"" + std::string(name) +
                                       "\" has no effect beside \"" + std::string(winner) +
                                       "\", as in PBRT-v3; leave one of them out");
  };
  const std::string_view winner = sigmaA ? "sigma_a" : color ? "color" : "";
  if (sigmaA && color) ignored("color", winner);
  if (!winner.empty() && eumelanin) ignored("eumelanin", winner);
  if (!winner.empty() && pheomelanin) ignored("pheomelanin", winner);
  if (winner.empty() && !eumelanin && !pheomelanin) {
    eumelanin = TextureUse<float>{TextureUse<float>::kConstant, kUsualEumelanin};
  }
  const auto eta = in.findFloat("eta", 1.55f, Range::positive());
  const auto betaM = in.findFloat("beta_m", 0.3f, Range::closed(0, 1)),
             betaN = in.findFloat("beta_n", 0.3f, Range::closed(0, 1));
  const auto alpha = in.findFloat("alpha", 2);
  return [=](Materials& m) {
    Textures& t = m.textures();
    const auto rgb = [&](const auto& use) { return use ? t.rgbTexture(*use) : nullptr; };
    return std::make_unique<HairMaterial>(HairMaterialParams{.sigmaA = rgb(sigmaA),
                                                             .color = rgb(color),
                                                             .eumelanin = t.floatTexture(eumelanin),
                                                             .pheomelanin = t.floatTexture(pheomelanin),
                                                             .eta = t.floatTexture(eta),
                                                             .betaM = t.floatTexture(betaM),
                                                             .betaN = t.floatTexture(betaN),
                                                             .alpha = t.floatTexture(alpha)});
  };
}

}  // namespace pbrtmedia
