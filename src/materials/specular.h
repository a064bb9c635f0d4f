// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/fresnel.h"
#include "materials/local_frame.h"
#include "materials/transport_mode.h"

namespace pbrtmedia {

/// A perfect mirror, weighted by a Fresnel term.
struct SpecularReflection {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Specular;

  Fresnel fresnel;

  Rgb f(Vector3f, Vector3f) const { return {}; }
  float pdf(Vector3f, Vector3f) const { return 0; }
  LobeSample sample(Vector3f wo, Point2f u) const;
};

/// Perfect refraction with weight 1 - F; radiance, not importance, is scaled by (eta_o/eta_i)².
struct SpecularTransmission {
  static constexpr BsdfFlags kFlags = BsdfFlags::Transmission | BsdfFlags::Specular;

  float etaA = 1, etaB = 1.5f;  ///< indices on the normal's side and the other; equal: straight through
  TransportMode mode = TransportMode::Radiance;

  Rgb f(Vector3f, Vector3f) const { return {}; }
  float pdf(Vector3f, Vector3f) const { return 0; }
  LobeSample sample(Vector3f wo, Point2f u) const;
};

/// Smooth glass in one lobe: reflects with probability F, else refracts.
struct FresnelSpecular {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Transmission | BsdfFlags::Specular;

  Rgb reflectance{1}, transmittance{1};
  float etaA = 1, etaB = 1.5f;
  TransportMode mode = TransportMode::Radiance;

  Rgb f(Vector3f, Vector3f) const { return {}; }
  float pdf(Vector3f, Vector3f) const { return 0; }
  /// `flags` of the sample hold the side that was chosen.
  LobeSample sample(Vector3f wo, Point2f u) const;
};

}  // namespace pbrtmedia
