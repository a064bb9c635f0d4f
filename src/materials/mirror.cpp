// SPDX-License-Identifier: BSD-2-Clause
#include "materials/mirror.h"

#include "materials/bump_map.h"
#include "materials/material_parts.h"

namespace pbrtmedia {

MirrorMaterial::MirrorMaterial(const MirrorParams& params) : params_(params) {
  requireTexture(params.kr, "mirror", "Kr");
}

std::size_t MirrorMaterial::maxLobes() const { return isAlwaysBlack(*params_.kr) ? 0 : 1; }

Bsdf MirrorMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool) const {
  applyBumpMap(params_.bumpMap, si);
  Bsdf bsdf(si, mode);
  const Rgb kr = reflectanceAt(*params_.kr, si);
  if (!kr.isBlack()) bsdf.add(Lobe(kr, SpecularReflection{NoFresnel{}}));
  return bsdf;
}

}  // namespace pbrtmedia
