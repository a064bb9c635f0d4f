// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>

#include "materials/local_frame.h"

namespace pbrtmedia {

/// What a fibre of hair is like at one point of its width.
struct HairParams {
  float h = 0;                       ///< where light meets the fibre across its width, in [-1, 1]
  float eta = 1.55f;                 ///< index of the fibre, > 0
  Rgb sigmaA{};                      ///< absorption per radius of the fibre
  float betaM = 0.3f, betaN = 0.3f;  ///< longitudinal and azimuthal roughness, in [0, 1]
  float alpha = 2;                   ///< degrees by which the scales tilt
};

/// Scattering by a dielectric cylinder with rough scales: Chiang, Bitterli, Tappan & Burley 2016, "A
/// Practical and Controllable Hair and Fur Model for Production Path Tracing", as PBRT-v3 has it
/// (scene-language reference 15.2): reflection, transmission and one internal reflection, and what is left in
/// one lobe that does not depend on the azimuth. The fibre runs along local x. Without absorption all light
/// comes out again.
class HairFibre {
 public:
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Transmission | BsdfFlags::Glossy;
  /// Smaller roughness counts as this: at 0 the lobes have no width.
  static constexpr float kMinRoughness = 0.01f;

  explicit HairFibre(const HairParams& params);

  /// Holds 1 / |cosθi|, as the cosine of a fibre is in the lobes.
  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;

  static constexpr std::size_t kLobes = 4;  ///< R, TT, TRT, all others

 private:
  struct View;
  View viewFrom(Vector3f wo) const;

  float h_, eta_;
  Rgb sigmaA_;
  float variance_;  ///< longitudinal, of R
  float scale_;     ///< of the logistic distribution in the azimuth
  float sinTilt_;   ///< sin(alpha)
};

/// The adjoint of a fibre on strands that turn to each ray (SurfaceInteraction::turnsToRays). Those are as
/// wide from all sides: how much of them a ray meets, the cosine to the normal on a surface, is here the
/// cosine of its inclination to the fibre.
struct StrandAdjoint {
  static constexpr BsdfFlags kFlags = HairFibre::kFlags;
  HairFibre law;

  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const { return law.pdf(wo, wi); }
  LobeSample sample(Vector3f wo, Point2f u) const;
};

/// Absorption from concentrations of the two melanins (>= 0).
Rgb hairAbsorption(float eumelanin, float pheomelanin);
/// Absorption that gives dense hair a colour (channels in (0, 1]) at an azimuthal roughness.
Rgb hairAbsorption(Rgb colour, float betaN);

}  // namespace pbrtmedia
