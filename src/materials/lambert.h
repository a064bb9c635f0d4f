// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/cosine_sampling.h"

namespace pbrtmedia {

/// Reflects the same radiance everywhere: f = 1/π.
struct LambertReflection {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Diffuse;

  Rgb f(Vector3f, Vector3f) const { return Rgb(kInvPi); }
  float pdf(Vector3f wo, Vector3f wi) const { return cosinePdf(wo, wi); }
  LobeSample sample(Vector3f wo, Point2f u) const { return sampleByCosine(*this, wo, u); }
};

/// Transmits the same radiance everywhere on the other side: f = 1/π.
struct LambertTransmission {
  static constexpr BsdfFlags kFlags = BsdfFlags::Transmission | BsdfFlags::Diffuse;

  Rgb f(Vector3f, Vector3f) const { return Rgb(kInvPi); }
  float pdf(Vector3f wo, Vector3f wi) const { return isSameHemisphere(wo, wi) ? 0 : std::abs(wi.z) * kInvPi; }
  LobeSample sample(Vector3f wo, Point2f u) const {
    Vector3f wi = sampleCosineHemisphere(u);
    if (wo.z > 0) wi.z = -wi.z;
    return {f(wo, wi), wi, pdf(wo, wi), kFlags};
  }
};

}  // namespace pbrtmedia
