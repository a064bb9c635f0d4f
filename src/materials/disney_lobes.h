// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/math.h"
#include "materials/fresnel.h"
#include "materials/local_frame.h"
#include "materials/microfacet.h"

// The lobes of Disney's principled material: Burley 2012, "Physically-Based Shading at Disney", and Burley
// 2015, "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering", as PBRT-v3 has them
// (scene-language reference 15.2). Colours are the weights of the lobes.

namespace pbrtmedia {

/// Diffuse reflection, darker at grazing angles by Fresnel's law: (1 - Fo/2)(1 - Fi/2) / π.
struct DisneyDiffuse {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Diffuse;

  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;
};

/// What stands in for subsurface scattering in thin surfaces, after Hanrahan & Krueger 1993.
struct DisneyFlatDiffuse {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Diffuse;
  float roughness = 0.5f;

  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;
};

/// Reflection back to where light comes from, of rough surfaces.
struct DisneyRetro {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Diffuse;
  float roughness = 0.5f;

  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;
};

/// The bright rim of cloth: (1 - wi·h)^5.
struct DisneySheen {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Diffuse;

  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;
};

/// Microfacets whose masking and shadowing are independent (G1 G1), between a dielectric and Schlick's law.
struct DisneyReflection {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Glossy;
  TrowbridgeReitz distribution;
  Rgb schlickR0;
  float metallic = 0, eta = 1.5f;

  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;
};

/// A thin varnish: GTR1 facets of index 1.5, a quarter of its full strength.
struct DisneyClearcoat {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Glossy;
  float alpha = 0.001f;  ///< (0, 1): width of the highlight

  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;
};

}  // namespace pbrtmedia
