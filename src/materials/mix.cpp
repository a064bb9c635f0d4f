// SPDX-License-Identifier: BSD-2-Clause
#include "materials/mix.h"

#include <stdexcept>
#include <string>

#include "materials/bssrdf.h"

namespace pbrtmedia {

MixMaterial::MixMaterial(const Material& material1, const Material& material2, const RgbTexture& amount)
    : material1_(&material1), material2_(&material2), amount_(&amount) {
  if (maxLobes() <= Bsdf::kMaxLobes) return;
  throw std::invalid_argument("material \"mix\": its two materials have up to " + std::to_string(maxLobes()) +
                              " lobes together, at most " + std::to_string(Bsdf::kMaxLobes) +
                              " are possible at one surface point");
}

Bsdf MixMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const {
  const Rgb weight1 = amount_->evaluate(si).nonNegative();
  const Rgb weight2 = (Rgb(1) - weight1).nonNegative();
  SurfaceInteraction other = si;  // the second bump map is applied here, and forgotten
  Bsdf bsdf = material1_->bsdf(si, mode, mergeSpecular);
  bsdf.scale(weight1);
  if (weight2.isBlack()) return bsdf;
  Bsdf second = material2_->bsdf(other, mode, mergeSpecular);
  second.scale(weight2);
  if (!material1_->hasBssrdf()) second.forgetSubsurface();
  for (std::size_t i = 0; i < second.lobeCount(); ++i) bsdf.add(second.lobe(i));
  return bsdf;
}

std::optional<Bssrdf> MixMaterial::bssrdf(const SurfaceInteraction& si) const {
  return material1_->bssrdf(si);
}

}  // namespace pbrtmedia
