// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/local_frame.h"
#include "materials/microfacet.h"

namespace pbrtmedia {

/// A glossy coat over a diffuse base that loses what the coat reflects: Ashikhmin & Shirley 2000 with a
/// Trowbridge-Reitz distribution; formulas in the scene-language reference 15.2 (substrate).
struct FresnelBlend {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Glossy;

  Rgb diffuse, specular;  ///< Kd, Ks
  TrowbridgeReitz distribution;

  Rgb f(Vector3f wo, Vector3f wi) const;
  /// Half cosine, half visible normals.
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;
};

}  // namespace pbrtmedia
