// SPDX-License-Identifier: BSD-2-Clause
#include "materials/subsurface.h"

#include <utility>

#include "materials/bssrdf.h"
#include "materials/bump_map.h"
#include "materials/material_parts.h"

namespace pbrtmedia {

SubsurfaceMaterial::SubsurfaceMaterial(const SubsurfaceBoundary& boundary,
                                       const SubsurfaceCoefficients& inside,
                                       std::shared_ptr<const SubsurfaceTable> table)
    : boundary_(boundary), coefficients_(inside), table_(std::move(table)) {
  requireTextures("subsurface");
  requireTexture(inside.sigmaA, "subsurface", "sigma_a");
  requireTexture(inside.sigmaS, "subsurface", "sigma_s");
}

SubsurfaceMaterial::SubsurfaceMaterial(const SubsurfaceBoundary& boundary, const SubsurfaceColour& inside,
                                       std::shared_ptr<const SubsurfaceTable> table)
    : boundary_(boundary), colour_(inside), table_(std::move(table)) {
  requireTextures("kdsubsurface");
  requireTexture(inside.kd, "kdsubsurface", "Kd");
  requireTexture(inside.meanFreePath, "kdsubsurface", "mfp");
}

void SubsurfaceMaterial::requireTextures(std::string_view name) const {
  requireTexture(boundary_.kr, name, "Kr");
  requireTexture(boundary_.kt, name, "Kt");
  requireTexture(boundary_.uRoughness, name, "uroughness");
  requireTexture(boundary_.vRoughness, name, "vroughness");
}

std::size_t SubsurfaceMaterial::maxLobes() const {
  return (isAlwaysBlack(*boundary_.kr) ? 0u : 1u) + (isAlwaysBlack(*boundary_.kt) ? 0u : 1u);
}

Bsdf SubsurfaceMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const {
  applyBumpMap(boundary_.bumpMap, si);
  const float eta = table_->eta();
  Bsdf bsdf(si, mode, eta);
  const Rgb kr = reflectanceAt(*boundary_.kr, si), kt = reflectanceAt(*boundary_.kt, si);
  addDielectric(bsdf,
                {kr, kt, eta, boundary_.uRoughness->evaluate(si), boundary_.vRoughness->evaluate(si),
                 boundary_.remapRoughness},
                mode, mergeSpecular, BsdfFlags::Subsurface);
  return bsdf;
}

std::optional<Bssrdf> SubsurfaceMaterial::bssrdf(const SurfaceInteraction& si) const {
  TabulatedProfile profile{table_.get(), {}, {}};
  if (coefficients_) {
    const Rgb sigmaA = coefficients_->scale * reflectanceAt(*coefficients_->sigmaA, si),
              sigmaS = coefficients_->scale * reflectanceAt(*coefficients_->sigmaS, si);
    profile.extinction = sigmaA + sigmaS;
    for (std::size_t c = 0; c < 3; ++c) {
      profile.albedo[c] = profile.extinction[c] > 0 ? sigmaS[c] / profile.extinction[c] : 0;
    }
  } else {
    const Rgb kd = reflectanceAt(*colour_->kd, si),
              path = colour_->scale * reflectanceAt(*colour_->meanFreePath, si);
    for (std::size_t c = 0; c < 3; ++c) {
      profile.extinction[c] = path[c] > 0 ? 1 / path[c] : 0;
      profile.albedo[c] = table_->albedoOf(kd[c]);
    }
  }
  return Bssrdf(profile, table_->eta());
}

}  // namespace pbrtmedia
