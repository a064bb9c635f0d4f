// SPDX-License-Identifier: BSD-2-Clause
#include "materials/metal.h"

#include "materials/bump_map.h"
#include "materials/material_parts.h"

namespace pbrtmedia {

MetalMaterial::MetalMaterial(const MetalParams& params) : params_(params) {
  requireTexture(params.eta, "metal", "eta");
  requireTexture(params.k, "metal", "k");
  if (params_.uRoughness == nullptr) params_.uRoughness = params.roughness;
  if (params_.vRoughness == nullptr) params_.vRoughness = params.roughness;
  requireTexture(params_.uRoughness, "metal", "roughness");
  requireTexture(params_.vRoughness, "metal", "roughness");
}

std::size_t MetalMaterial::maxLobes() const { return 1; }

Bsdf MetalMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool) const {
  applyBumpMap(params_.bumpMap, si);
  Bsdf bsdf(si, mode);
  const float u = params_.uRoughness->evaluate(si), v = params_.vRoughness->evaluate(si);
  const ConductorFresnel fresnel{params_.eta->evaluate(si), params_.k->evaluate(si)};
  bsdf.add(Lobe(Rgb(1), MicrofacetReflection{distributionAt(u, v, params_.remapRoughness), fresnel}));
  return bsdf;
}

}  // namespace pbrtmedia
