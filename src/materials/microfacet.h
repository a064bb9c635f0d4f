// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/vec.h"

namespace pbrtmedia {

/// Trowbridge-Reitz (GGX) distribution of microfacet normals, anisotropic, in the local frame (z: the
/// macroscopic normal). Scene-language reference 15.1.
class TrowbridgeReitz {
 public:
  /// Roughness 0 is not a mirror: smaller values are floored here.
  static constexpr float kMinAlpha = 0.001f;

  TrowbridgeReitz() = default;
  /// Width along local x and y; NaN is floored too.
  TrowbridgeReitz(float alphaX, float alphaY)
      : alphaX_(alphaX > kMinAlpha ? alphaX : kMinAlpha), alphaY_(alphaY > kMinAlpha ? alphaY : kMinAlpha) {}

  /// PBRT-v3's "remaproughness": a polynomial in ln(max(roughness, 0.001)); 0 gives 0.0473, 1 gives 1.62.
  static float alphaFromRoughness(float roughness);

  float alphaX() const { return alphaX_; }
  float alphaY() const { return alphaY_; }
  /// Density D(h) of facet area per solid angle, [1/sr]; h unit, even in h.
  float density(Vector3f h) const;
  /// Smith's auxiliary function, >= 0; infinite at grazing w.
  float lambda(Vector3f w) const;
  /// Share of facets visible from w: 1 / (1 + Λ).
  float masking(Vector3f w) const { return 1 / (1 + lambda(w)); }
  /// Height-correlated masking and shadowing: 1 / (1 + Λ(o) + Λ(i)).
  float maskingShadowing(Vector3f wo, Vector3f wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }

  /// A normal in proportion to its area visible from wo (wo.z != 0), on the side of wo. Heitz 2018, JCGT
  /// 7(4).
  Vector3f sampleVisible(Vector3f wo, Point2f u) const;
  /// Solid-angle density of `sampleVisible`: D(h) G1(wo) |wo·h| / |wo.z|.
  float pdfVisible(Vector3f wo, Vector3f h) const;
  /// The same for wi, the mirror image of wo about h: pdfVisible / (4 |wo·h|), without the division.
  float pdfReflected(Vector3f wo, Vector3f h) const;

 private:
  float alphaX_ = kMinAlpha, alphaY_ = kMinAlpha;
};

}  // namespace pbrtmedia
