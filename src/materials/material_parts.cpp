// SPDX-License-Identifier: BSD-2-Clause
#include "materials/material_parts.h"

#include <stdexcept>
#include <string>

namespace pbrtmedia {

void requireTexture(const void* texture, std::string_view material, std::string_view parameter) {
  if (texture != nullptr) return;
  throw std::invalid_argument("material \"" + std::string(material) + "\": no texture for \"" +
                              std::string(parameter) + "\"");
}

bool isAlwaysBlack(const RgbTexture& texture) {
  const auto* constant = dynamic_cast<const ConstantTexture<Rgb>*>(&texture);
  return constant != nullptr && reflectanceAt(*constant, SurfaceInteraction{}).isBlack();
}

bool isAlways(const FloatTexture& texture, float value) {
  const auto* constant = dynamic_cast<const ConstantTexture<float>*>(&texture);
  return constant != nullptr && constant->evaluate(SurfaceInteraction{}) == value;
}

void addDielectric(Bsdf& bsdf, const Dielectric& of, TransportMode mode, bool mergeSpecular,
                   BsdfFlags marks) {
  const auto& [kr, kt, eta, u, v, remap] = of;
  if (kr.isBlack() && kt.isBlack()) return;
  const auto transmit = [&](Lobe lobe) {
    lobe.setFlag(marks);
    bsdf.add(lobe);
  };
  const DielectricFresnel fresnel{1, eta};
  // Facets of a boundary between equal indices bend nothing, however rough: the limit is the smooth case.
  if ((u == 0 && v == 0) || eta == 1) {
    if (mergeSpecular) return transmit(Lobe(Rgb(1), FresnelSpecular{kr, kt, 1, eta, mode}));
    if (!kr.isBlack()) bsdf.add(Lobe(kr, SpecularReflection{fresnel}));
    if (!kt.isBlack()) transmit(Lobe(kt, SpecularTransmission{1, eta, mode}));
    return;
  }
  const TrowbridgeReitz distribution = distributionAt(u, v, remap);
  if (!kr.isBlack()) bsdf.add(Lobe(kr, MicrofacetReflection{distribution, fresnel}));
  if (!kt.isBlack()) transmit(Lobe(kt, MicrofacetTransmission{distribution, 1, eta, mode}));
}

}  // namespace pbrtmedia
