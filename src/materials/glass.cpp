// SPDX-License-Identifier: BSD-2-Clause
#include "materials/glass.h"

#include "materials/bump_map.h"
#include "materials/material_parts.h"

namespace pbrtmedia {

GlassMaterial::GlassMaterial(const GlassParams& params) : params_(params) {
  requireTexture(params.kr, "glass", "Kr");
  requireTexture(params.kt, "glass", "Kt");
  requireTexture(params.eta, "glass", "eta");
  requireTexture(params.uRoughness, "glass", "uroughness");
  requireTexture(params.vRoughness, "glass", "vroughness");
}

std::size_t GlassMaterial::maxLobes() const {
  return (isAlwaysBlack(*params_.kr) ? 0u : 1u) + (isAlwaysBlack(*params_.kt) ? 0u : 1u);
}

Bsdf GlassMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const {
  applyBumpMap(params_.bumpMap, si);
  const float eta = params_.eta->evaluate(si);
  Bsdf bsdf(si, mode, eta);
  const Rgb kr = reflectanceAt(*params_.kr, si), kt = reflectanceAt(*params_.kt, si);
  if (kr.isBlack() && kt.isBlack()) return bsdf;

  const float u = params_.uRoughness->evaluate(si), v = params_.vRoughness->evaluate(si);
  const DielectricFresnel fresnel{1, eta};
  // Facets of a boundary between equal indices bend nothing, however rough: the limit is the smooth case.
  if ((u == 0 && v == 0) || eta == 1) {
    if (mergeSpecular) {
      bsdf.add(Lobe(Rgb(1), FresnelSpecular{kr, kt, 1, eta, mode}));
      return bsdf;
    }
    if (!kr.isBlack()) bsdf.add(Lobe(kr, SpecularReflection{fresnel}));
    if (!kt.isBlack()) bsdf.add(Lobe(kt, SpecularTransmission{1, eta, mode}));
    return bsdf;
  }
  const TrowbridgeReitz distribution = distributionAt(u, v, params_.remapRoughness);
  if (!kr.isBlack()) bsdf.add(Lobe(kr, MicrofacetReflection{distribution, fresnel}));
  if (!kt.isBlack()) bsdf.add(Lobe(kt, MicrofacetTransmission{distribution, 1, eta, mode}));
  return bsdf;
}

}  // namespace pbrtmedia
