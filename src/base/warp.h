// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/math.h"
#include "base/vec.h"

// Maps from the unit square to directions and discs. Each `sampleX` has a `pdfX` in the measure its comment
// names.

namespace pbrtmedia {

/// Concentric map of Shirley & Chiu 1997 to the unit disc; area measure, pdf 1/pi.
inline Point2f sampleConcentricDisk(Point2f u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  float r, theta;
  if (std::abs(a) > std::abs(b)) {
    r = a;
    theta = (kPi / 4) * (b / a);
  } else {
    r = b;
    theta = kPi / 2 - (kPi / 4) * (a / b);
  }
  return {r * std::cos(theta), r * std::sin(theta)};
}

/// Cosine-weighted hemisphere around +z; solid angle.
inline Vector3f sampleCosineHemisphere(Point2f u) {
  const Point2f d = sampleConcentricDisk(u);
  return {d.x, d.y, safeSqrt(1 - d.x * d.x - d.y * d.y)};
}
inline float pdfCosineHemisphere(float cosTheta) { return cosTheta > 0 ? cosTheta * kInvPi : 0; }

/// Uniform sphere; solid angle, pdf 1/(4 pi).
inline Vector3f sampleUniformSphere(Point2f u) {
  const float z = 1 - 2 * u.x, r = safeSqrt(1 - z * z), phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}
inline constexpr float pdfUniformSphere() { return kInv4Pi; }

/// Uniform hemisphere around +z; solid angle, pdf 1/(2 pi).
inline Vector3f sampleUniformHemisphere(Point2f u) {
  const float z = u.x, r = safeSqrt(1 - z * z), phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}
inline constexpr float pdfUniformHemisphere() { return kInv2Pi; }

/// Uniform cone around +z with half-angle acos(cosMax), written with 1 - cosMax so that tiny cones keep their
/// digits; solid angle.
inline Vector3f sampleUniformCone(Point2f u, float oneMinusCosMax) {
  const float oneMinusCos = u.x * oneMinusCosMax;
  const float sin2 = oneMinusCos * (2 - oneMinusCos), phi = 2 * kPi * u.y, sinTheta = safeSqrt(sin2);
  return {sinTheta * std::cos(phi), sinTheta * std::sin(phi), 1 - oneMinusCos};
}
inline float pdfUniformCone(float oneMinusCosMax) { return 1 / (2 * kPi * oneMinusCosMax); }

/// Uniform barycentric coordinates (b0, b1), b2 = 1 - b0 - b1.
inline Point2f sampleUniformTriangle(Point2f u) {
  const float s = std::sqrt(u.x);
  return {1 - s, u.y * s};
}

/// Veach's power heuristic with exponent 2 for one sample of each technique; safe for huge pdfs.
inline float powerHeuristic(float pdfA, float pdfB) {
  if (!(pdfA > 0)) return 0;
  const float r = pdfB / pdfA;
  return 1 / (1 + r * r);
}

}  // namespace pbrtmedia
