// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <optional>

#include "base/vec.h"
#include "materials/bsdf_flags.h"
#include "spectrum/rgb.h"

// Directions in the shading frame: z along the shading normal, both pointing away from the surface.

namespace pbrtmedia {

struct LobeSample {
  Rgb f;                              ///< without the cosine; for specular lobes weight / |cos|
  Vector3f wi;                        ///< unit, local
  float pdf = 0;                      ///< solid angle, or probability of a specular choice; 0: no sample
  BsdfFlags flags = BsdfFlags::None;  ///< what the sample does
};

constexpr bool isSameHemisphere(Vector3f a, Vector3f b) { return a.z * b.z > 0; }

/// Mirror image of w about the unit vector n.
constexpr Vector3f reflect(Vector3f w, Vector3f n) { return 2 * dot(w, n) * n - w; }

/// Refracted direction of `w` at a boundary with unit normal `n` on w's side (w·n > 0); `eta`: index on w's
/// side over the other one. Nothing under total internal reflection. Equal indices give exactly -w.
inline std::optional<Vector3f> refract(Vector3f w, Vector3f n, float eta) {
  if (eta == 1) return -w;
  const float cosI = dot(w, n);
  const float sin2T = eta * eta * std::max(0.0f, 1 - cosI * cosI);
  if (sin2T >= 1) return std::nullopt;
  return -eta * w + (eta * cosI - std::sqrt(1 - sin2T)) * n;
}

}  // namespace pbrtmedia
