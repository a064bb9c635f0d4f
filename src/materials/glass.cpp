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
  addDielectric(bsdf,
                {reflectanceAt(*params_.kr, si), reflectanceAt(*params_.kt, si), eta,
                 params_.uRoughness->evaluate(si), params_.vRoughness->evaluate(si), params_.remapRoughness},
                mode, mergeSpecular);
  return bsdf;
}

}  // namespace pbrtmedia
