// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/sppm/photon_gather.h"

#include <cmath>
#include <numbers>

#include "materials/bsdf.h"
#include "media/phase/phase_function.h"

namespace pbrtmedia {
namespace {

/// In double, as thousands are added that differ widely.
struct PowerSum {
  double r = 0, g = 0, b = 0;
  void add(Rgb power) {
    r += power.r;
    g += power.g;
    b += power.b;
  }
  Rgb over(double divisor) const {
    return {static_cast<float>(r / divisor), static_cast<float>(g / divisor),
            static_cast<float>(b / divisor)};
  }
};

/// Scattered power over the scattering coefficient; none where nothing scatters.
Rgb fluence(Rgb power, Rgb sigmaS) {
  Rgb quotient;
  for (std::size_t c = 0; c < 3; ++c) {
    if (sigmaS[c] != 0) quotient[c] = power[c] / sigmaS[c];
  }
  return quotient;
}

}  // namespace

Rgb PhotonGather::scatteredOnSurface(const SurfaceInteraction& si, const Bsdf& bsdf, int vertex) {
  const double radius{radii_.onSurfaces};
  const Normal3f shading = bsdf.shadingNormal();
  // The density of photons goes by the geometric cosine, scattering by that of the shading normal.
  const bool isShadedFlat = shading == si.n || shading == -si.n;
  PowerSum sum;
  maps_.onSurfaces.within(si.p, radii_.onSurfaces, [&](const Photon& photon, float) {
    if (!joins(photon, vertex)) return;
    ++found_.onSurfaces;
    const Rgb f = bsdf.f(si.wo, photon.wi, BsdfFlags::AllButSpecular);
    if (f.isBlack()) return;
    const float cosines = isShadedFlat ? 1 : absDot(photon.wi, shading) / absDot(photon.wi, si.n);
    sum.add(f * photon.power * cosines);
  });
  return sum.over(std::numbers::pi * radius * radius * maps_.paths);
}

Rgb PhotonGather::scatteredInMedium(Point3f p, Vector3f wo, const PhaseFunction& phase, Rgb sigmaS,
                                    int vertex) {
  const double radius{radii_.inMedia};
  PowerSum sum;
  maps_.inMedia.within(p, radii_.inMedia, [&](const MediumPhoton& photon, float) {
    if (!joins(photon, vertex)) return;
    ++found_.inMedia;
    sum.add(phase.evaluate(wo, photon.wi) * fluence(photon.power, 0.5f * (sigmaS + photon.sigmaS)));
  });
  return sum.over(4 * std::numbers::pi / 3 * radius * radius * radius * maps_.paths);
}

}  // namespace pbrtmedia
