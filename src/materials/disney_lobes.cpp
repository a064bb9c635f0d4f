// SPDX-License-Identifier: BSD-2-Clause
#include "materials/disney_lobes.h"

#include <cmath>

#include "materials/cosine_sampling.h"

namespace pbrtmedia {
namespace {

/// wi·h of the half vector; nothing for opposite directions.
std::optional<float> cosineToHalf(Vector3f wo, Vector3f wi) {
  const float sum = length(wo + wi);
  if (!(sum > 0)) return std::nullopt;
  return 0.5f * sum;  // the same for unit vectors, without a loss of digits
}

float fresnelAt(Vector3f w) { return schlickWeight(std::abs(w.z)); }

constexpr float kCoatReflectance = 0.04f;  // of index 1.5, seen straight on
constexpr float kCoatMaskingAlpha = 0.25f;

/// Burley 2012, Eq. (4) with γ = 1.
float gtr1(float cosine, float alpha) {
  const float a2 = sqr(alpha);
  return (a2 - 1) / (kPi * std::log(a2) * (1 + (a2 - 1) * sqr(cosine)));
}

/// Masking of one direction, with the factor 1 / (2 |cos|) of the microfacet law in it.
float coatMasking(float cosine) {
  const float a2 = sqr(kCoatMaskingAlpha), c2 = sqr(cosine);
  return 1 / (cosine + std::sqrt(a2 + c2 - a2 * c2));
}

}  // namespace

Rgb DisneyDiffuse::f(Vector3f wo, Vector3f wi) const {
  return Rgb(kInvPi * (1 - 0.5f * fresnelAt(wo)) * (1 - 0.5f * fresnelAt(wi)));
}
float DisneyDiffuse::pdf(Vector3f wo, Vector3f wi) const { return cosinePdf(wo, wi); }
LobeSample DisneyDiffuse::sample(Vector3f wo, Point2f u) const { return sampleByCosine(*this, wo, u); }

Rgb DisneyFlatDiffuse::f(Vector3f wo, Vector3f wi) const {
  const std::optional<float> cosine = cosineToHalf(wo, wi);
  const float sum = std::abs(wo.z) + std::abs(wi.z);
  if (!cosine || !(sum > 0)) return {};
  const float at90 = sqr(*cosine) * roughness;
  const float fss = lerp(fresnelAt(wo), 1.0f, at90) * lerp(fresnelAt(wi), 1.0f, at90);
  return Rgb(kInvPi * 1.25f * (fss * (1 / sum - 0.5f) + 0.5f));
}
float DisneyFlatDiffuse::pdf(Vector3f wo, Vector3f wi) const { return cosinePdf(wo, wi); }
LobeSample DisneyFlatDiffuse::sample(Vector3f wo, Point2f u) const { return sampleByCosine(*this, wo, u); }

Rgb DisneyRetro::f(Vector3f wo, Vector3f wi) const {
  const std::optional<float> cosine = cosineToHalf(wo, wi);
  if (!cosine) return {};
  const float fo = fresnelAt(wo), fi = fresnelAt(wi), r = 2 * roughness * sqr(*cosine);
  return Rgb(kInvPi * r * (fo + fi + fo * fi * (r - 1)));
}
float DisneyRetro::pdf(Vector3f wo, Vector3f wi) const { return cosinePdf(wo, wi); }
LobeSample DisneyRetro::sample(Vector3f wo, Point2f u) const { return sampleByCosine(*this, wo, u); }

Rgb DisneySheen::f(Vector3f wo, Vector3f wi) const {
  const std::optional<float> cosine = cosineToHalf(wo, wi);
  return cosine ? Rgb(schlickWeight(*cosine)) : Rgb();
}
float DisneySheen::pdf(Vector3f wo, Vector3f wi) const { return cosinePdf(wo, wi); }
LobeSample DisneySheen::sample(Vector3f wo, Point2f u) const { return sampleByCosine(*this, wo, u); }

Rgb DisneyReflection::f(Vector3f wo, Vector3f wi) const {
  const float cosO = std::abs(wo.z), cosI = std::abs(wi.z);
  const Vector3f sum = wo + wi;
  if (cosO == 0 || cosI == 0 || !(lengthSquared(sum) > 0)) return {};
  const Vector3f h = normalize(sum);
  const float cosine = h.z < 0 ? -dot(wi, h) : dot(wi, h);
  const Rgb schlick = schlickR0 + schlickWeight(cosine) * (Rgb(1) - schlickR0);
  const Rgb fresnel = (1 - metallic) * Rgb(fresnelDielectric(cosine, 1, eta)) + metallic * schlick;
  return fresnel *
         (distribution.density(h) * distribution.masking(wo) * distribution.masking(wi) / (4 * cosO * cosI));
}
float DisneyReflection::pdf(Vector3f wo, Vector3f wi) const {
  return isSameHemisphere(wo, wi) ? distribution.pdfReflected(wo, normalize(wo + wi)) : 0;
}
LobeSample DisneyReflection::sample(Vector3f wo, Point2f u) const {
  const Vector3f wi = reflect(wo, distribution.sampleVisible(wo, u));
  if (!isSameHemisphere(wo, wi)) return {};
  return {f(wo, wi), wi, pdf(wo, wi), kFlags};
}

Rgb DisneyClearcoat::f(Vector3f wo, Vector3f wi) const {
  const Vector3f sum = wo + wi;
  if (!(lengthSquared(sum) > 0)) return {};
  const Vector3f h = normalize(sum);
  const float fresnel = lerp(schlickWeight(dot(wo, h)), kCoatReflectance, 1.0f);
  return Rgb(0.25f * gtr1(h.z, alpha) * fresnel * coatMasking(std::abs(wo.z)) * coatMasking(std::abs(wi.z)));
}
float DisneyClearcoat::pdf(Vector3f wo, Vector3f wi) const {
  if (!isSameHemisphere(wo, wi)) return 0;
  const Vector3f h = normalize(wo + wi);
  return gtr1(h.z, alpha) * std::abs(h.z) / (4 * dot(wo, h));
}
LobeSample DisneyClearcoat::sample(Vector3f wo, Point2f u) const {
  if (wo.z == 0) return {};
  const float a2 = sqr(alpha);
  const float cosine = safeSqrt((1 - std::pow(a2, 1 - u.x)) / (1 - a2)), sine = safeSqrt(1 - sqr(cosine));
  const float phi = 2 * kPi * u.y;
  Vector3f h{sine * std::cos(phi), sine * std::sin(phi), cosine};
  if (wo.z < 0) h = -h;
  const Vector3f wi = reflect(wo, h);
  if (!isSameHemisphere(wo, wi)) return {};
  return {f(wo, wi), wi, pdf(wo, wi), kFlags};
}

}  // namespace pbrtmedia
