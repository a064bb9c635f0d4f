// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/fresnel.h"
#include "materials/local_frame.h"
#include "materials/microfacet.h"
#include "materials/transport_mode.h"

namespace pbrtmedia {

/// Reflection by microfacets: f = D G F / (4 cosθo cosθi), F at wi·h with h on the normal's side (Torrance &
/// Sparrow 1967).
struct MicrofacetReflection {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Glossy;

  TrowbridgeReitz distribution;
  Fresnel fresnel;

  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;
};

/// Refraction by microfacets of a dielectric: Walter et al. 2007, Eq. (21), which is already the law for
/// radiance seen along wo (it holds the factor (eta_o/eta_i)²); importance is without it. F at wo·h.
struct MicrofacetTransmission {
  static constexpr BsdfFlags kFlags = BsdfFlags::Transmission | BsdfFlags::Glossy;

  TrowbridgeReitz distribution;
  float etaA = 1, etaB = 1.5f;  ///< indices on the normal's side and the other; must differ
  TransportMode mode = TransportMode::Radiance;
  bool isMaskingSeparable = false;  ///< G1(wo) G1(wi), as Disney's material has it

  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;
};

}  // namespace pbrtmedia
