// SPDX-License-Identifier: BSD-2-Clause
#include "materials/fresnel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pbrtmedia {

float fresnelDielectric(float cosI, float etaI, float etaT) {
  cosI = std::clamp(cosI, -1.0f, 1.0f);
  if (cosI < 0) {
    std::swap(etaI, etaT);
    cosI = -cosI;
  }
  const float ratio = etaI / etaT;
  const float sin2T = ratio * ratio * (1 - cosI * cosI);  // Snell
  if (sin2T >= 1) return 1;
  const float cosT = std::sqrt(1 - sin2T);
  const float parallel = (etaT * cosI - etaI * cosT) / (etaT * cosI + etaI * cosT);
  const float perpendicular = (etaI * cosI - etaT * cosT) / (etaI * cosI + etaT * cosT);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

namespace {

// Born & Wolf, Principles of Optics, 14.4: with (a + ib)² = (eta + ik)² - sin²,
//   Rs = |c - (a + ib)|² / |c + (a + ib)|²,   Rp = Rs |(a + ib) - s²/c|² / |(a + ib) + s²/c|²;
// the second is multiplied by c², so that grazing angles divide by nothing.
float conductorChannel(float c, float eta, float k) {
  const float c2 = c * c, s2 = 1 - c2;
  const float real = eta * eta - k * k - s2;
  const float modulus = std::hypot(real, 2 * eta * k);  // a² + b²
  const float a = std::sqrt(std::max(0.0f, 0.5f * (modulus + real)));
  const float rs = (modulus + c2 - 2 * a * c) / (modulus + c2 + 2 * a * c);
  const float even = modulus * c2 + s2 * s2, odd = 2 * a * c * s2;
  // Grazing on vacuum (eta 1, k 0) is 0/0: such a "conductor" is not there.
  if (!(modulus + c2 > 0)) return 0;
  const float rp = rs * (even + odd > 0 ? (even - odd) / (even + odd) : 1.0f);
  return 0.5f * (rs + rp);
}

}  // namespace

Rgb fresnelConductor(float cosI, Rgb eta, Rgb k) {
  const float c = std::min(std::abs(cosI), 1.0f);
  return {conductorChannel(c, eta.r, k.r), conductorChannel(c, eta.g, k.g), conductorChannel(c, eta.b, k.b)};
}

}  // namespace pbrtmedia
