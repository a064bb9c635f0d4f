// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/local_frame.h"

namespace pbrtmedia {

/// First and second moment of the Fresnel reflectance, ∫ F(cos) cos^k dcos, by the polynomials of d'Eon &
/// Irving 2011 ("A Quantized-Diffusion Model for Rendering Translucent Materials"); `eta`: index of the other
/// side over that of this one. Larger ones than the polynomials are for count as `kLargestMomentIndex`:
/// beyond it they tell of more light than there is.
inline constexpr float kLargestMomentIndex = 2.8f;
double fresnelMoment1(double eta);
double fresnelMoment2(double eta);

/// How light leaves a surface that it went below: the part Sw of a separable BSSRDF, which sends all of it
/// out, f = (1 - F(cosθi)) / (c π) with c = 1 - 2 M1(1/eta). For radiance it grows by eta² as it comes from
/// the denser side, for importance it does not. Holds on the normal's side only.
struct SubsurfaceExit {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Diffuse;

  SubsurfaceExit(float eta, bool isRadiance);

  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;

 private:
  float eta_, scale_;
};

}  // namespace pbrtmedia
