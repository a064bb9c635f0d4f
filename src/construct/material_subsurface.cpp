// SPDX-License-Identifier: BSD-2-Clause
#include <functional>

#include "construct/material_kinds.h"
#include "construct/tolerance.h"
#include "materials/subsurface.h"
#include "materials/subsurface_exit.h"
#include "media/presets.h"

namespace pbrtmedia {
namespace {

/// A number that cannot be a texture.
float findNumber(Texturable& in, std::string_view name, float fallback, Range range) {
  const TextureUse<float> use = in.findFloat(name, fallback, range);
  if (!use.isConstant()) {
    tolerate(in.own(), ParamKind::Texture, name, "cannot be a texture; the default is used, as in PBRT-v3");
  }
  return use.constant;
}

using MakeBoundary = std::function<SubsurfaceBoundary(Materials&)>;

MakeBoundary readBoundary(Texturable& in) {
  const auto kr = in.findRgb("Kr", Rgb(1)), kt = in.findRgb("Kt", Rgb(1));
  const auto u = in.findFloat("uroughness", 0), v = in.findFloat("vroughness", 0);
  const bool remap = in.findBool("remaproughness", true);
  const auto bump = in.optionalFloat("bumpmap");
  return [=](Materials& m) {
    Textures& t = m.textures();
    return SubsurfaceBoundary{.kr = t.rgbTexture(kr),
                              .kt = t.rgbTexture(kt),
                              .uRoughness = t.floatTexture(u),
                              .vRoughness = t.floatTexture(v),
                              .remapRoughness = remap,
                              .bumpMap = t.floatTexture(bump)};
  };
}

constexpr float kEta = 1.33f;
constexpr Range kMeanCosine = Range::open(-1, 1);

float readIndex(Texturable& in) {
  const float eta = findNumber(in, "eta", kEta, Range::positive());
  warnOfIndexBelowSurface(in, eta);
  return eta;
}

}  // namespace

void warnOfIndexBelowSurface(Texturable& in, float eta) {
  constexpr float kMost = kLargestMomentIndex;
  if (eta <= kMost && eta >= 1 / kMost) return;
  ParamReader& told = in.readerOf(ParamKind::Float, "eta");
  told.diagnostics().warning(
      told.locationOf(ParamKind::Float, "eta"),
      told.context() + ": parameter \"eta\": found " + shownNumber(eta) + ", expected " +
          shownNumber(1 / kMost) + " to " + shownNumber(kMost) +
          " where light goes below the surface: how much of it the surface sends "
          "back down is taken as at the nearer end; PBRT-v3 makes light of nothing there");
}

Materials::Make readSubsurface(Texturable& in) {
  Rgb defaultA(.0011f, .0024f, .014f), defaultS(2.55f, 3.21f, 3.77f);
  float g = findNumber(in, "g", 0, kMeanCosine);
  if (const std::optional<std::string> name = in.optionalString("name"); name && !name->empty()) {
    if (const std::optional<MediumPreset> preset = findPreset(*name)) {
      defaultA = preset->sigmaA;
      defaultS = preset->sigmaPrimeS;
      g = 0;  // measured scattering is the reduced one
    } else {
      std::vector<std::string_view> known;
      for (const MediumPreset& p : mediumPresets()) known.push_back(p.name);
      tolerate(in.own(), ParamKind::String, "name",
               "unknown medium \"" + *name + "\"" + suggestion(*name, known) +
                   "; the default coefficients are used, as in PBRT-v3");
    }
  }
  const auto sigmaA = in.findRgb("sigma_a", defaultA), sigmaS = in.findRgb("sigma_s", defaultS);
  const float scale = findNumber(in, "scale", 1, Range::nonNegative());
  const float eta = readIndex(in);
  const MakeBoundary boundary = readBoundary(in);
  return [=](Materials& m) {
    Textures& t = m.textures();
    const SubsurfaceCoefficients inside{t.rgbTexture(sigmaA), t.rgbTexture(sigmaS), scale};
    return std::make_unique<SubsurfaceMaterial>(boundary(m), inside, m.subsurfaceTable(g, eta));
  };
}

Materials::Make readKdSubsurface(Texturable& in) {
  const auto kd = in.findRgb("Kd", Rgb(0.5f)), path = in.findRgb("mfp", Rgb(1));
  const float g = findNumber(in, "g", 0, kMeanCosine);
  const float scale = findNumber(in, "scale", 1, Range::nonNegative());
  const float eta = readIndex(in);
  const MakeBoundary boundary = readBoundary(in);
  return [=](Materials& m) {
    Textures& t = m.textures();
    const SubsurfaceColour inside{t.rgbTexture(kd), t.rgbTexture(path), scale};
    return std::make_unique<SubsurfaceMaterial>(boundary(m), inside, m.subsurfaceTable(g, eta));
  };
}

}  // namespace pbrtmedia
