// SPDX-License-Identifier: BSD-2-Clause
#include "materials/matte.h"

#include <algorithm>

#include "materials/bump_map.h"
#include "materials/material_parts.h"

namespace pbrtmedia {

MatteMaterial::MatteMaterial(const MatteParams& params) : params_(params) {
  requireTexture(params.kd, "matte", "Kd");
  requireTexture(params.sigma, "matte", "sigma");
}

std::size_t MatteMaterial::maxLobes() const { return isAlwaysBlack(*params_.kd) ? 0 : 1; }

Bsdf MatteMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool) const {
  applyBumpMap(params_.bumpMap, si);
  Bsdf bsdf(si, mode);
  const Rgb kd = reflectanceAt(*params_.kd, si);
  if (kd.isBlack()) return bsdf;
  const float sigma = std::clamp(params_.sigma->evaluate(si), 0.0f, 90.0f);
  bsdf.add(sigma == 0 ? Lobe(kd, LambertReflection{}) : Lobe(kd, OrenNayar(sigma)));
  return bsdf;
}

}  // namespace pbrtmedia
