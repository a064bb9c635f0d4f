// SPDX-License-Identifier: BSD-2-Clause
#include "materials/bump_map.h"

#include <cmath>

namespace pbrtmedia {

namespace {

/// Steps in u and v, scene-language reference 15.1.
constexpr float kUnknownStep = 0.0005f;
float step(float perX, float perY) {
  const float half = 0.5f * (std::abs(perX) + std::abs(perY));
  return half > 0 && std::isfinite(half) ? half : kUnknownStep;
}

}  // namespace

void applyBumpMap(const FloatTexture* displacement, SurfaceInteraction& si) {
  if (displacement == nullptr) return;
  const float du = step(si.dudx, si.dudy), dv = step(si.dvdx, si.dvdy);
  const float here = displacement->evaluate(si);
  SurfaceInteraction shifted = si;
  shifted.p = si.p + du * si.shading.dpdu;
  shifted.uv = {si.uv.x + du, si.uv.y};
  const float alongU = displacement->evaluate(shifted);
  shifted.p = si.p + dv * si.shading.dpdv;
  shifted.uv = {si.uv.x, si.uv.y + dv};
  const float alongV = displacement->evaluate(shifted);

  const SurfaceInteraction::Shading& s = si.shading;
  const Vector3f dpdu = s.dpdu + ((alongU - here) / du) * s.n + here * s.dndu;
  const Vector3f dpdv = s.dpdv + ((alongV - here) / dv) * s.n + here * s.dndv;
  const Vector3f normal = cross(dpdu, dpdv);
  const float length2 = lengthSquared(normal);
  if (!(length2 > 0) || !std::isfinite(length2)) return;
  si.setShading(normal / std::sqrt(length2), dpdu, dpdv, Normal3f(s.dndu), Normal3f(s.dndv), false);
}

}  // namespace pbrtmedia
