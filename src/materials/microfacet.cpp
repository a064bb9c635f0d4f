// SPDX-License-Identifier: BSD-2-Clause
#include "materials/microfacet.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace pbrtmedia {

float TrowbridgeReitz::alphaFromRoughness(float roughness) {
  constexpr float kMinRoughness = 1e-3f;  // scene-language reference 15.1
  const float x = std::log(std::max(roughness, kMinRoughness));
  return 1.62142f + x * (0.819955f + x * (0.1734f + x * (0.0171201f + x * 0.000640711f)));
}

float TrowbridgeReitz::density(Vector3f h) const {
  const float e = sqr(h.x / alphaX_) + sqr(h.y / alphaY_) + h.z * h.z;  // cos² (1 + tan² (...))
  return 1 / (kPi * alphaX_ * alphaY_ * e * e);
}

float TrowbridgeReitz::lambda(Vector3f w) const {
  const float slope2 = (sqr(alphaX_ * w.x) + sqr(alphaY_ * w.y)) / (w.z * w.z);
  return std::isnan(slope2) ? 0 : 0.5f * (std::sqrt(1 + slope2) - 1);
}

Vector3f TrowbridgeReitz::sampleVisible(Vector3f wo, Point2f u) const {
  const float side = wo.z < 0 ? -1.0f : 1.0f;
  const Vector3f v = side * wo;
  // Stretch so that the facets become a hemisphere, and look at its disc from there.
  const Vector3f stretched = normalize(Vector3f{alphaX_ * v.x, alphaY_ * v.y, v.z});
  const float across2 = sqr(stretched.x) + sqr(stretched.y);
  const Vector3f t1 =
      across2 > 0 ? Vector3f{-stretched.y, stretched.x, 0} / std::sqrt(across2) : Vector3f{1, 0, 0};
  const Vector3f t2 = cross(stretched, t1);
  const float r = std::sqrt(u.x), phi = 2 * kPi * u.y;
  const float d1 = r * std::cos(phi);
  const float lit = 0.5f * (1 + stretched.z);  // share of the disc's half that the hemisphere hides
  const float d2 = lerp(lit, safeSqrt(1 - d1 * d1), r * std::sin(phi));
  const Vector3f n = d1 * t1 + d2 * t2 + safeSqrt(1 - d1 * d1 - d2 * d2) * stretched;
  // The floor keeps a facet seen edge-on from having no direction at all.
  return side * normalize(Vector3f{alphaX_ * n.x, alphaY_ * n.y, std::max(1e-6f, n.z)});
}

float TrowbridgeReitz::pdfVisible(Vector3f wo, Vector3f h) const {
  if (wo.z == 0) return 0;
  return density(h) * masking(wo) * absDot(wo, h) / std::abs(wo.z);
}

float TrowbridgeReitz::pdfReflected(Vector3f wo, Vector3f h) const {
  if (wo.z == 0) return 0;
  return density(h) * masking(wo) / (4 * std::abs(wo.z));
}

}  // namespace pbrtmedia
