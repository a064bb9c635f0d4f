// SPDX-License-Identifier: BSD-2-Clause
#include "materials/fourier.h"

#include "materials/bump_map.h"

namespace pbrtmedia {

Bsdf FourierMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool) const {
  applyBumpMap(bumpMap_, si);
  Bsdf bsdf(si, mode, table_->eta());
  bsdf.add(Lobe(Rgb(1), RareLobe(FourierScattering{table_.get()}, mode)));
  return bsdf;
}

}  // namespace pbrtmedia
