// SPDX-License-Identifier: BSD-2-Clause
#include "materials/translucent.h"

#include "materials/bump_map.h"
#include "materials/material_parts.h"

namespace pbrtmedia {

TranslucentMaterial::TranslucentMaterial(const TranslucentParams& params) : params_(params) {
  requireTexture(params.kd, "translucent", "Kd");
  requireTexture(params.ks, "translucent", "Ks");
  requireTexture(params.reflect, "translucent", "reflect");
  requireTexture(params.transmit, "translucent", "transmit");
  requireTexture(params.roughness, "translucent", "roughness");
}

std::size_t TranslucentMaterial::maxLobes() const {
  const std::size_t kinds = (isAlwaysBlack(*params_.kd) ? 0u : 1u) + (isAlwaysBlack(*params_.ks) ? 0u : 1u);
  const std::size_t sides =
      (isAlwaysBlack(*params_.reflect) ? 0u : 1u) + (isAlwaysBlack(*params_.transmit) ? 0u : 1u);
  return kinds * sides;
}

Bsdf TranslucentMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool) const {
  constexpr float kEta = 1.5f;
  applyBumpMap(params_.bumpMap, si);
  Bsdf bsdf(si, mode, kEta);
  const Rgb reflect = reflectanceAt(*params_.reflect, si), transmit = reflectanceAt(*params_.transmit, si);
  const Rgb kd = reflectanceAt(*params_.kd, si), ks = reflectanceAt(*params_.ks, si);
  const auto addUnlessBlack = [&bsdf](Rgb weight, const LobeModel& model) {
    if (!weight.isBlack()) bsdf.add(Lobe(weight, model));
  };
  addUnlessBlack(reflect * kd, LambertReflection{});
  addUnlessBlack(transmit * kd, LambertTransmission{});
  if (ks.isBlack()) return bsdf;
  const float roughness = params_.roughness->evaluate(si);
  const TrowbridgeReitz distribution = distributionAt(roughness, roughness, params_.remapRoughness);
  addUnlessBlack(reflect * ks, MicrofacetReflection{distribution, DielectricFresnel{1, kEta}});
  addUnlessBlack(transmit * ks, MicrofacetTransmission{distribution, 1, kEta, mode});
  return bsdf;
}

}  // namespace pbrtmedia
