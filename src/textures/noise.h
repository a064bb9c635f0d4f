// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/vec.h"

namespace pbrtmedia {

/// Gradient noise in [-1, 1] on the unit lattice, period 256: Perlin 2002, doi:10.1145/566654.566636, with
/// the published permutation. Gradients of the hashes 12 to 15 are PBRT-v3's (scene-language reference 14.4),
/// not the paper's. 0 at lattice points and where |p| is so large that every float is one; 0 for non-finite
/// p.
float noise(Point3f p);
/// The plane z = 1/2.
inline float noise(float x, float y) { return noise(Point3f{x, y, 0.5f}); }

/// Parameters of the fractal sums.
struct FractalParams {
  int octaves = 8;         ///< >= 0
  float roughness = 0.5f;  ///< weight of an octave over that of the previous one
};

/// Sum of octaves at frequencies 1.99^i, cut off where an octave is finer than the footprint (dpdx, dpdy);
/// may be negative. A zero footprint: all octaves.
float fbm(Point3f p, Vector3f dpdx, Vector3f dpdy, const FractalParams& params);
/// The same sum over |noise|; octaves that are cut off contribute their mean, 0.2.
float turbulence(Point3f p, Vector3f dpdx, Vector3f dpdy, const FractalParams& params);

}  // namespace pbrtmedia
