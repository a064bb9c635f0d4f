// SPDX-License-Identifier: BSD-2-Clause
#include "materials/specular.h"

#include <cmath>

#include "base/math.h"

namespace pbrtmedia {

namespace {

struct Refracted {
  Vector3f wi;
  float scale;  ///< radiance is squeezed with the solid angle: (eta_o/eta_i)²; importance is not
};

std::optional<Refracted> refractAtSurface(Vector3f wo, float etaA, float etaB, TransportMode mode) {
  const bool fromFront = wo.z > 0;
  const float eta = fromFront ? etaA / etaB : etaB / etaA;
  const std::optional<Vector3f> wi = refract(wo, {0, 0, fromFront ? 1.0f : -1.0f}, eta);
  if (!wi || wi->z == 0) return std::nullopt;
  return Refracted{*wi, mode == TransportMode::Radiance ? eta * eta : 1.0f};
}

}  // namespace

LobeSample SpecularReflection::sample(Vector3f wo, Point2f) const {
  const Vector3f wi{-wo.x, -wo.y, wo.z};
  return {evaluateFresnel(fresnel, wi.z) / std::abs(wi.z), wi, 1, kFlags};
}

LobeSample SpecularTransmission::sample(Vector3f wo, Point2f) const {
  const std::optional<Refracted> t = refractAtSurface(wo, etaA, etaB, mode);
  if (!t) return {};
  const float transmitted = 1 - fresnelDielectric(wo.z, etaA, etaB);
  return {Rgb(transmitted * t->scale / std::abs(t->wi.z)), t->wi, 1, kFlags};
}

LobeSample FresnelSpecular::sample(Vector3f wo, Point2f u) const {
  const float reflected = fresnelDielectric(wo.z, etaA, etaB);
  if (u.x < reflected) {
    const Vector3f wi{-wo.x, -wo.y, wo.z};
    return {reflectance * (reflected / std::abs(wi.z)), wi, reflected,
            BsdfFlags::Specular | BsdfFlags::Reflection};
  }
  const std::optional<Refracted> t = refractAtSurface(wo, etaA, etaB, mode);
  if (!t) return {};
  return {transmittance * ((1 - reflected) * t->scale / std::abs(t->wi.z)), t->wi, 1 - reflected,
          BsdfFlags::Specular | BsdfFlags::Transmission};
}

}  // namespace pbrtmedia
