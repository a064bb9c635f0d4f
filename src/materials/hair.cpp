// SPDX-License-Identifier: BSD-2-Clause
#include "materials/hair.h"

#include <algorithm>
#include <stdexcept>

#include "materials/hair_fibre.h"
#include "materials/material_parts.h"

namespace pbrtmedia {

HairMaterial::HairMaterial(const HairMaterialParams& params) : params_(params) {
  requireTexture(params.eta, "hair", "eta");
  requireTexture(params.betaM, "hair", "beta_m");
  requireTexture(params.betaN, "hair", "beta_n");
  requireTexture(params.alpha, "hair", "alpha");
  if (!params.sigmaA && !params.color && !params.eumelanin && !params.pheomelanin)
    throw std::invalid_argument("material \"hair\": nothing says what it absorbs");
}

Rgb HairMaterial::absorptionAt(const SurfaceInteraction& si, float betaN) const {
  if (params_.sigmaA) return reflectanceAt(*params_.sigmaA, si);
  if (params_.color) return hairAbsorption(reflectanceAt(*params_.color, si), betaN);
  const auto concentration = [&](const FloatTexture* texture) {
    return texture ? std::max(0.0f, texture->evaluate(si)) : 0;
  };
  return hairAbsorption(concentration(params_.eumelanin), concentration(params_.pheomelanin));
}

Bsdf HairMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool) const {
  const float eta = params_.eta->evaluate(si), betaN = params_.betaN->evaluate(si);
  Bsdf bsdf(si, mode, eta);
  const HairFibre fibre({.h = 2 * si.uv.y - 1,
                         .eta = eta,
                         .sigmaA = absorptionAt(si, betaN),
                         .betaM = params_.betaM->evaluate(si),
                         .betaN = betaN,
                         .alpha = params_.alpha->evaluate(si)});
  const bool isAdjointOfStrand = mode == TransportMode::Importance && si.turnsToRays;
  bsdf.add(Lobe(Rgb(1), isAdjointOfStrand ? RareLobe(StrandAdjoint{fibre}) : RareLobe(fibre, mode)));
  return bsdf;
}

}  // namespace pbrtmedia
