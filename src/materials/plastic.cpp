// SPDX-License-Identifier: BSD-2-Clause
#include "materials/plastic.h"

#include "materials/bump_map.h"
#include "materials/material_parts.h"

namespace pbrtmedia {

PlasticMaterial::PlasticMaterial(const PlasticParams& params) : params_(params) {
  requireTexture(params.kd, "plastic", "Kd");
  requireTexture(params.ks, "plastic", "Ks");
  requireTexture(params.roughness, "plastic", "roughness");
}

std::size_t PlasticMaterial::maxLobes() const {
  return (isAlwaysBlack(*params_.kd) ? 0u : 1u) + (isAlwaysBlack(*params_.ks) ? 0u : 1u);
}

Bsdf PlasticMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool) const {
  applyBumpMap(params_.bumpMap, si);
  Bsdf bsdf(si, mode);
  const Rgb kd = reflectanceAt(*params_.kd, si);
  if (!kd.isBlack()) bsdf.add(Lobe(kd, LambertReflection{}));
  const Rgb ks = reflectanceAt(*params_.ks, si);
  if (!ks.isBlack()) {
    const float roughness = params_.roughness->evaluate(si);
    // Exchanged indices: what PBRT-v3 renders, and what scenes were tuned against.
    bsdf.add(Lobe(ks, MicrofacetReflection{distributionAt(roughness, roughness, params_.remapRoughness),
                                           DielectricFresnel{1.5f, 1.0f}}));
  }
  return bsdf;
}

}  // namespace pbrtmedia
