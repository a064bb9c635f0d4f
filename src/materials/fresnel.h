// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <variant>

#include "spectrum/rgb.h"

namespace pbrtmedia {

/// Unpolarised reflectance of a smooth boundary between two dielectrics, in [0, 1]; 1 under total internal
/// reflection. `cosI` in [-1, 1] (clamped) from the boundary's normal, which points into the medium of index
/// `etaI`; a negative cosine comes from the other side and swaps the indices. Indices > 0.
float fresnelDielectric(float cosI, float etaI, float etaT);

/// Unpolarised reflectance, per channel, of a conductor with complex index eta + i k seen from vacuum. Only
/// |cosI| counts.
Rgb fresnelConductor(float cosI, Rgb eta, Rgb k);

/// Schlick's (1 - cos)^5, the cosine clamped to [0, 1].
constexpr float schlickWeight(float cosine) {
  const float m = cosine < 0 ? 1.0f : (cosine > 1 ? 0.0f : 1 - cosine);
  return (m * m) * (m * m) * m;
}

/// Reflects everything.
struct NoFresnel {
  Rgb operator()(float) const { return Rgb(1); }
};
struct DielectricFresnel {
  float etaI = 1, etaT = 1.5f;  ///< on the normal's side, on the other
  Rgb operator()(float cosI) const { return Rgb(fresnelDielectric(cosI, etaI, etaT)); }
};
struct ConductorFresnel {
  Rgb eta, k;
  Rgb operator()(float cosI) const { return fresnelConductor(cosI, eta, k); }
};

/// How much a reflecting lobe reflects at a cosine.
using Fresnel = std::variant<NoFresnel, DielectricFresnel, ConductorFresnel>;

inline Rgb evaluateFresnel(const Fresnel& fresnel, float cosI) {
  return std::visit([cosI](const auto& f) { return f(cosI); }, fresnel);
}

}  // namespace pbrtmedia
