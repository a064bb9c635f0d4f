// SPDX-License-Identifier: BSD-2-Clause
#include "materials/substrate.h"

#include "materials/bump_map.h"
#include "materials/material_parts.h"

namespace pbrtmedia {

SubstrateMaterial::SubstrateMaterial(const SubstrateParams& params) : params_(params) {
  requireTexture(params.kd, "substrate", "Kd");
  requireTexture(params.ks, "substrate", "Ks");
  requireTexture(params.uRoughness, "substrate", "uroughness");
  requireTexture(params.vRoughness, "substrate", "vroughness");
}

std::size_t SubstrateMaterial::maxLobes() const {
  return isAlwaysBlack(*params_.kd) && isAlwaysBlack(*params_.ks) ? 0 : 1;
}

Bsdf SubstrateMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool) const {
  applyBumpMap(params_.bumpMap, si);
  Bsdf bsdf(si, mode);
  const Rgb kd = reflectanceAt(*params_.kd, si), ks = reflectanceAt(*params_.ks, si);
  if (kd.isBlack() && ks.isBlack()) return bsdf;
  const float u = params_.uRoughness->evaluate(si), v = params_.vRoughness->evaluate(si);
  bsdf.add(Lobe(Rgb(1), FresnelBlend{kd, ks, distributionAt(u, v, params_.remapRoughness)}));
  return bsdf;
}

}  // namespace pbrtmedia
