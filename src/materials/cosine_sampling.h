// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/warp.h"
#include "materials/local_frame.h"

// Directions of reflection by the cosine, which several laws have.

namespace pbrtmedia {

/// Solid-angle density of `wi`, on the side of `wo`.
inline float cosinePdf(Vector3f wo, Vector3f wi) {
  return isSameHemisphere(wo, wi) ? std::abs(wi.z) * kInvPi : 0;
}

template <class Law>
LobeSample sampleByCosine(const Law& law, Vector3f wo, Point2f u) {
  Vector3f wi = sampleCosineHemisphere(u);
  if (wo.z < 0) wi.z = -wi.z;
  return {law.f(wo, wi), wi, cosinePdf(wo, wi), Law::kFlags};
}

}  // namespace pbrtmedia
