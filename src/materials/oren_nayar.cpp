// SPDX-License-Identifier: BSD-2-Clause
#include "materials/oren_nayar.h"

#include "base/math.h"

namespace pbrtmedia {

OrenNayar::OrenNayar(float sigmaDegrees) {
  const float s2 = sqr(radians(sigmaDegrees));
  a_ = 1 - s2 / (2 * (s2 + 0.33f));
  b_ = 0.45f * s2 / (s2 + 0.09f);
}

Rgb OrenNayar::f(Vector3f wo, Vector3f wi) const {
  const float sinO = safeSqrt(1 - wo.z * wo.z), sinI = safeSqrt(1 - wi.z * wi.z);
  float maxCos = 0;  // max(0, cos of the azimuth between them); any value will do at the pole
  if (sinO > 1e-4f && sinI > 1e-4f) {
    maxCos = std::max(0.0f, (wi.x * wo.x + wi.y * wo.y) / (sinI * sinO));
  }
  const float cosO = std::abs(wo.z), cosI = std::abs(wi.z);
  const float larger = std::max(cosO, cosI);  // belongs to the smaller angle β
  if (larger == 0) return Rgb(a_ * kInvPi);
  const float sinAlphaTanBeta = cosI > cosO ? sinO * sinI / cosI : sinI * sinO / cosO;
  return Rgb(kInvPi * (a_ + b_ * maxCos * sinAlphaTanBeta));
}

}  // namespace pbrtmedia
