// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/sppm/photon_gather.h"

#include "materials/bsdf.h"
#include "media/phase/phase_function.h"

namespace pbrtmedia {
namespace {

/// In double, as thousands are added that differ widely.
struct PowerSum {
  double r = 0, g = 0, b = 0;
  void add(Rgb power, double weight) {
    r += weight * double{power.r};
    g += weight * double{power.g};
    b += weight * double{power.b};
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
  const DiscKernel& kernel = kernels_.onSurfaces;
  const Normal3f shading = bsdf.shadingNormal();
  // The density of photons goes by the cosine where they are, scattering by that of the shading normal here.
  const bool isShadedFlat = shading == si.n || shading == -si.n;
  PowerSum sum;
  maps_.onSurfaces.within(si.p, kernel.radius(), [&](const SurfacePhoton& photon, float distance2) {
    if (!joins(photon, vertex)) return;
    ++found_.onSurfaces;
    const Rgb f = bsdf.f(si.wo, photon.wi, BsdfFlags::AllButSpecular);
    if (f.isBlack()) return;
    const float cosines = isShadedFlat ? 1 : absDot(photon.wi, shading) / photon.cosine;
    sum.add(f * photon.power * cosines, kernel(distance2));
  });
  return sum.over(kernel.measure() * maps_.paths);
}

Rgb PhotonGather::scatteredInMedium(Point3f p, Vector3f wo, const PhaseFunction& phase, Rgb sigmaS,
                                    int vertex) {
  const BallKernel& kernel = kernels_.inMedia;
  PowerSum sum;
  maps_.inMedia.within(p, kernel.radius(), [&](const MediumPhoton& photon, float distance2) {
    if (!joins(photon, vertex)) return;
    ++found_.inMedia;
    sum.add(phase.evaluate(wo, photon.wi) * fluence(photon.power, 0.5f * (sigmaS + photon.sigmaS)),
            kernel(distance2));
  });
  return sum.over(kernel.measure() * maps_.paths);
}

}  // namespace pbrtmedia
