// SPDX-License-Identifier: BSD-2-Clause
#include "construct/material_kinds.h"
#include "construct/tolerance.h"
#include "materials/fourier.h"
#include "materials/matte.h"

namespace pbrtmedia {

Materials::Make readFourier(Texturable& in) {
  constexpr std::string_view kBlackInstead = "the surface is black, as in PBRT-v3";
  const std::optional<std::filesystem::path> file = in.findInputFile("bsdffile", kBlackInstead);
  ParamReader& told = in.readerOf(ParamKind::String, "bsdffile");
  if (!file && !told.has(ParamKind::String, "bsdffile")) {
    tolerate(told, "parameter \"bsdffile\" is missing; " + std::string(kBlackInstead));
  }
  const auto bump = in.optionalFloat("bumpmap");
  const SourceLocation at = told.locationOf(ParamKind::String, "bsdffile");
  const std::string context = told.context();
  return [=](Materials& m) -> std::unique_ptr<Material> {
    Textures& t = m.textures();
    if (file) {
      try {
        return std::make_unique<FourierMaterial>(m.fourierTable(*file), t.floatTexture(bump));
      } catch (const SceneError& e) {
        m.diagnostics().tolerated(
            at, context + ": parameter \"bsdffile\": " + problemOf(e) + "; " + std::string(kBlackInstead));
      }
    }
    const TextureUse<Rgb> black{TextureUse<Rgb>::kConstant, Rgb(0)};
    const TextureUse<float> zero{TextureUse<float>::kConstant, 0.0f};
    return std::make_unique<MatteMaterial>(
        MatteParams{.kd = t.rgbTexture(black), .sigma = t.floatTexture(zero)});
  };
}

}  // namespace pbrtmedia
