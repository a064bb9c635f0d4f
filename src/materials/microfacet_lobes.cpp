// SPDX-License-Identifier: BSD-2-Clause
#include "materials/microfacet_lobes.h"

#include <cmath>

#include "base/math.h"

namespace pbrtmedia {

namespace {

constexpr Vector3f kNormal{0, 0, 1};

/// The facet normal, on the macroscopic normal's side, that refracts wo into wi, with the numbers both the
/// law and its density need. Nothing when no facet does.
struct RefractingFacet {
  Vector3f h;
  float eta;  ///< index on wi's side over that on wo's
  float oDotH, iDotH;
  float sum2;  ///< (wo·h + eta wi·h)²
};

std::optional<RefractingFacet> refractingFacet(Vector3f wo, Vector3f wi, float etaA, float etaB) {
  if (wo.z == 0 || wi.z == 0 || isSameHemisphere(wo, wi)) return std::nullopt;
  const float eta = wo.z > 0 ? etaB / etaA : etaA / etaB;
  const Vector3f sum = wo + eta * wi;
  if (!(lengthSquared(sum) > 0)) return std::nullopt;
  const Vector3f h = faceForward(normalize(sum), kNormal);
  const float o = dot(wo, h), i = dot(wi, h);
  // The facet must be seen from its front, and refract to its back.
  if (o * wo.z <= 0 || o * i >= 0) return std::nullopt;
  return RefractingFacet{h, eta, o, i, sqr(o + eta * i)};
}

}  // namespace

Rgb MicrofacetReflection::f(Vector3f wo, Vector3f wi) const {
  const float cosO = std::abs(wo.z), cosI = std::abs(wi.z);
  Vector3f h = wo + wi;
  if (cosO == 0 || cosI == 0 || !(lengthSquared(h) > 0)) return {};
  h = normalize(h);
  const Rgb reflected = evaluateFresnel(fresnel, dot(wi, faceForward(h, kNormal)));
  return reflected * (distribution.density(h) * distribution.maskingShadowing(wo, wi) / (4 * cosO * cosI));
}

float MicrofacetReflection::pdf(Vector3f wo, Vector3f wi) const {
  if (!isSameHemisphere(wo, wi)) return 0;
  const Vector3f h = normalize(wo + wi);
  return distribution.pdfReflected(wo, h);
}

LobeSample MicrofacetReflection::sample(Vector3f wo, Point2f u) const {
  const Vector3f h = distribution.sampleVisible(wo, u);
  const Vector3f wi = reflect(wo, h);
  if (!isSameHemisphere(wo, wi)) return {};
  return {f(wo, wi), wi, pdf(wo, wi), kFlags};
}

Rgb MicrofacetTransmission::f(Vector3f wo, Vector3f wi) const {
  const std::optional<RefractingFacet> facet = refractingFacet(wo, wi, etaA, etaB);
  if (!facet) return {};
  const float transmitted = 1 - fresnelDielectric(facet->oDotH, etaA, etaB);
  // Eq. (21) of Walter et al., both parts divided by the square of the index on wo's side.
  const float seen = isMaskingSeparable ? distribution.masking(wo) * distribution.masking(wi)
                                        : distribution.maskingShadowing(wo, wi);
  const Rgb radiance(transmitted * distribution.density(facet->h) * seen *
                     std::abs(facet->oDotH * facet->iDotH / (wo.z * wi.z)) / facet->sum2);
  return mode == TransportMode::Radiance ? radiance : radiance * sqr(facet->eta);
}

float MicrofacetTransmission::pdf(Vector3f wo, Vector3f wi) const {
  const std::optional<RefractingFacet> facet = refractingFacet(wo, wi, etaA, etaB);
  if (!facet) return 0;
  const float jacobian = sqr(facet->eta) * std::abs(facet->iDotH) / facet->sum2;  // Eq. (17)
  return distribution.pdfVisible(wo, facet->h) * jacobian;
}

LobeSample MicrofacetTransmission::sample(Vector3f wo, Point2f u) const {
  const Vector3f h = distribution.sampleVisible(wo, u);
  if (dot(wo, h) <= 0) return {};
  const std::optional<Vector3f> wi = refract(wo, h, wo.z > 0 ? etaA / etaB : etaB / etaA);
  if (!wi || isSameHemisphere(wo, *wi)) return {};
  return {f(wo, *wi), *wi, pdf(wo, *wi), kFlags};
}

}  // namespace pbrtmedia
