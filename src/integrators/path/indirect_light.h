// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/vec.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

class Bsdf;
class PhaseFunction;
struct SurfaceInteraction;

/// Somebody who knows the light that reaches a vertex of a camera path after it was scattered elsewhere, from
/// photons for instance: what the path finds at its first such vertex is then the light of sources alone, and
/// the rest is asked for here. Of one path at a time.
class IndirectLight {
 public:
  virtual ~IndirectLight() = default;
  /// Radiance that the lobes that are not specular scatter toward si.wo. `vertex`: number of scatterings of
  /// the path up to and with this one.
  virtual Rgb scatteredOnSurface(const SurfaceInteraction& si, const Bsdf& bsdf, int vertex) = 0;
  /// The integral over all directions of the radiance that arrives at `p` in a medium times its phase
  /// function toward unit `wo`. `sigmaS`: scattering coefficient there, 1/length.
  virtual Rgb scatteredInMedium(Point3f p, Vector3f wo, const PhaseFunction& phase, Rgb sigmaS,
                                int vertex) = 0;
};

}  // namespace pbrtmedia
