// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/cosine_sampling.h"

namespace pbrtmedia {

/// Rough diffuse reflection of V-shaped Lambertian grooves: Oren & Nayar 1994, doi:10.1145/192161.192213, the
/// qualitative model (their Eq. 30) with 0.33, as PBRT-v3 has it. σ = 0 is Lambert.
class OrenNayar {
 public:
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Diffuse;

  /// `sigmaDegrees`: standard deviation of the groove slope angle, [0, 90] degrees.
  explicit OrenNayar(float sigmaDegrees);

  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const { return cosinePdf(wo, wi); }
  LobeSample sample(Vector3f wo, Point2f u) const { return sampleByCosine(*this, wo, u); }

 private:
  float a_, b_;
};

}  // namespace pbrtmedia
