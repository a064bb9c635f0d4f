// SPDX-License-Identifier: BSD-2-Clause
#include "materials/fourier_scattering.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "materials/fourier_table.h"

namespace pbrtmedia {
namespace {

/// Cosine of the azimuth between light that flies along -wi, and wo.
float cosineOfAzimuth(Vector3f wo, Vector3f wi) {
  const float length2 = (sqr(wo.x) + sqr(wo.y)) * (sqr(wi.x) + sqr(wi.y));
  if (!(length2 > 0)) return 1;
  return std::clamp(-(wo.x * wi.x + wo.y * wi.y) / std::sqrt(length2), -1.0f, 1.0f);
}

/// Tables of splines and series that cancel each other may have quotients beyond all numbers: no light.
float finiteOrZero(float x) { return std::isfinite(x) ? x : 0; }

}  // namespace

Rgb FourierScattering::f(Vector3f wo, Vector3f wi) const {
  const float muI = -wi.z, muO = wo.z;
  if (muI == 0) return {};
  const FourierTable::Blend blend(*table, muI, muO);
  float scale = 1 / std::abs(muI);
  if (muI * muO > 0) scale *= muI > 0 ? 1 / sqr(table->eta()) : sqr(table->eta());
  const Rgb f = scale * blend.value(cosineOfAzimuth(wo, wi));
  return {finiteOrZero(f.r), finiteOrZero(f.g), finiteOrZero(f.b)};
}

float FourierScattering::pdf(Vector3f wo, Vector3f wi) const {
  const float whole = FourierTable::Blend::whole(*table, wo.z);
  if (!(whole > 0)) return 0;
  const float luminance = FourierTable::Blend(*table, -wi.z, wo.z).luminance(cosineOfAzimuth(wo, wi));
  return finiteOrZero(std::max(0.0f, luminance) / whole);
}

LobeSample FourierScattering::sample(Vector3f wo, Point2f u) const {
  if (!(FourierTable::Blend::whole(*table, wo.z) > 0)) return {};
  const float muI = std::clamp(FourierTable::Blend::sampleMu(*table, wo.z, u.y), -1.0f, 1.0f);
  const float phi = FourierTable::Blend(*table, muI, wo.z).samplePhi(u.x);
  const float sine = safeSqrt(1 - sqr(muI)), sineO = std::hypot(wo.x, wo.y);
  const Vector2f along = sineO > 0 ? Vector2f{wo.x / sineO, wo.y / sineO} : Vector2f{1, 0};
  const float c = std::cos(phi), s = std::sin(phi);
  const Vector3f wi{-sine * (c * along.x - s * along.y), -sine * (s * along.x + c * along.y), -muI};
  const float density = pdf(wo, wi);
  if (!(density > 0)) return {};
  return {f(wo, wi), wi, density, kFlags};
}

}  // namespace pbrtmedia
