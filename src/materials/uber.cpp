// SPDX-License-Identifier: BSD-2-Clause
#include "materials/uber.h"

#include "materials/bump_map.h"
#include "materials/material_parts.h"

namespace pbrtmedia {

UberMaterial::UberMaterial(const UberParams& params) : params_(params) {
  requireTexture(params.kd, "uber", "Kd");
  requireTexture(params.ks, "uber", "Ks");
  requireTexture(params.kr, "uber", "Kr");
  requireTexture(params.kt, "uber", "Kt");
  requireTexture(params.opacity, "uber", "opacity");
  requireTexture(params.eta, "uber", "eta");
  if (params_.uRoughness == nullptr) params_.uRoughness = params.roughness;
  if (params_.vRoughness == nullptr) params_.vRoughness = params_.uRoughness;
  requireTexture(params_.uRoughness, "uber", "roughness");
}

std::size_t UberMaterial::maxLobes() const {
  std::size_t lobes = 0;
  for (const RgbTexture* weight : {params_.kd, params_.ks, params_.kr, params_.kt}) {
    lobes += isAlwaysBlack(*weight) ? 0 : 1;
  }
  const auto* opacity = dynamic_cast<const ConstantTexture<Rgb>*>(params_.opacity);
  const bool isOpaque = opacity != nullptr && opacity->evaluate(SurfaceInteraction{}).min() >= 1;
  return lobes + (isOpaque ? 0 : 1);
}

Bsdf UberMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool) const {
  applyBumpMap(params_.bumpMap, si);
  const float eta = params_.eta->evaluate(si);
  const Rgb opacity = reflectanceAt(*params_.opacity, si);
  const Rgb through = (Rgb(1) - opacity).nonNegative();
  Bsdf bsdf(si, mode, through.isBlack() ? eta : 1.0f);
  if (!through.isBlack()) bsdf.add(Lobe(through, SpecularTransmission{1, 1}));

  const Rgb kd = opacity * reflectanceAt(*params_.kd, si);
  if (!kd.isBlack()) bsdf.add(Lobe(kd, LambertReflection{}));
  const DielectricFresnel fresnel{1, eta};
  const Rgb ks = opacity * reflectanceAt(*params_.ks, si);
  if (!ks.isBlack()) {
    const float u = params_.uRoughness->evaluate(si), v = params_.vRoughness->evaluate(si);
    bsdf.add(Lobe(ks, MicrofacetReflection{distributionAt(u, v, params_.remapRoughness), fresnel}));
  }
  const Rgb kr = opacity * reflectanceAt(*params_.kr, si);
  if (!kr.isBlack()) bsdf.add(Lobe(kr, SpecularReflection{fresnel}));
  const Rgb kt = opacity * reflectanceAt(*params_.kt, si);
  if (!kt.isBlack()) bsdf.add(Lobe(kt, SpecularTransmission{1, eta, mode}));
  return bsdf;
}

}  // namespace pbrtmedia
