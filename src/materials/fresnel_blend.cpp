// SPDX-License-Identifier: BSD-2-Clause
#include "materials/fresnel_blend.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/warp.h"
#include "materials/fresnel.h"

namespace pbrtmedia {

Rgb FresnelBlend::f(Vector3f wo, Vector3f wi) const {
  const float cosO = std::abs(wo.z), cosI = std::abs(wi.z);
  const Vector3f sum = wo + wi;
  const float sumLength = length(sum);
  if (!(std::max(cosO, cosI) > 0) || !(sumLength > 0)) return {};
  const Vector3f h = sum / sumLength;
  constexpr float kDiffuseNorm = 28 * kInvPi / 23;
  const Rgb base = kDiffuseNorm * (1 - schlickWeight(0.5f * cosI)) * (1 - schlickWeight(0.5f * cosO)) *
                   diffuse * (Rgb(1) - specular);
  const float iDotH = 0.5f * sumLength;  // the same for unit vectors, and never 0
  const Rgb schlick = specular + schlickWeight(iDotH) * (Rgb(1) - specular);
  return base + schlick * (distribution.density(h) / (4 * iDotH * std::max(cosO, cosI)));
}

float FresnelBlend::pdf(Vector3f wo, Vector3f wi) const {
  if (!isSameHemisphere(wo, wi)) return 0;
  const Vector3f h = normalize(wo + wi);
  return 0.5f * (std::abs(wi.z) * kInvPi + distribution.pdfReflected(wo, h));
}

LobeSample FresnelBlend::sample(Vector3f wo, Point2f u) const {
  Vector3f wi;
  if (u.x < 0.5f) {
    wi = sampleCosineHemisphere({std::min(2 * u.x, kOneMinusEpsilon), u.y});
    if (wo.z < 0) wi.z = -wi.z;
  } else {
    wi = reflect(wo, distribution.sampleVisible(wo, {std::min(2 * (u.x - 0.5f), kOneMinusEpsilon), u.y}));
    if (!isSameHemisphere(wo, wi)) return {};
  }
  return {f(wo, wi), wi, pdf(wo, wi), kFlags};
}

}  // namespace pbrtmedia
