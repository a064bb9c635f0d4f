// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>

#include "base/vec.h"
#include "materials/bsdf_flags.h"
#include "materials/lobes.h"
#include "materials/transport_mode.h"
#include "shapes/surface_interaction.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

struct BsdfSample {
  Rgb f;                              ///< without the cosine; for specular lobes f = weight / |cos|
  Vector3f wi;                        ///< unit, world space
  float pdf = 0;                      ///< solid angle (all matching lobes); 0: no sample
  BsdfFlags flags = BsdfFlags::None;  ///< of the lobe that was sampled
};

/// A sum of lobes in one shading frame: a plain value, no allocation. Rules of the scene-language
/// reference 15.1: reflection or transmission is judged by the geometric normal, the cosine uses the shading
/// normal. For importance, f is what makes f |wi·ns| the adjoint of that, in both of its uses (sampling on
/// and connecting): f of radiance with wo and wi exchanged, times `shadingCorrection`.
class Bsdf {
 public:
  static constexpr std::size_t kMaxLobes = 8;

  Bsdf() = default;  ///< no lobes: black
  /// `eta`: relative index of the surface, for roulette book-keeping (1: none).
  Bsdf(const SurfaceInteraction& si, TransportMode mode, float eta = 1);

  /// CHECK-fails past kMaxLobes (construction refuses such mixes).
  void add(const Lobe& lobe);
  std::size_t count(BsdfFlags allowed = BsdfFlags::All) const;
  float eta() const { return eta_; }
  Normal3f shadingNormal() const { return frame_.n; }

  /// |wo·ns| |wi·ng| / (|wo·ng| |wi·ns|) with the shading normal ns and the geometric normal ng: Veach 1997,
  /// section 5.3. Unbounded at grazing angles; 0 where a direction lies in one of the planes.
  float shadingCorrection(Vector3f wo, Vector3f wi) const;

  /// World-space unit directions, both pointing away from the surface.
  Rgb f(Vector3f wo, Vector3f wi, BsdfFlags allowed = BsdfFlags::All) const;
  float pdf(Vector3f wo, Vector3f wi, BsdfFlags allowed = BsdfFlags::All) const;
  /// Picks a matching lobe uniformly with u.x (stretched for reuse), then a direction.
  BsdfSample sample(Vector3f wo, Point2f u, BsdfFlags allowed = BsdfFlags::All) const;

  /// Makes lobes marked Subsurface events, as specular ones are: they can be sampled, and have a part in
  /// neither f nor the density of directions. For who asks for Material::bssrdf.
  void separateSubsurface();
  /// What the lobes let through is not scattered below the surface.
  void forgetSubsurface();

  /// Lobes and frame, for the mix material.
  std::size_t lobeCount() const { return count_; }
  const Lobe& lobe(std::size_t i) const { return lobes_[i]; }
  /// Multiplies every lobe's weight; lobes that become black are dropped.
  void scale(Rgb weight);

 private:
  std::array<Lobe, kMaxLobes> lobes_;  // only the first count_ are ever read
  std::size_t count_ = 0;
  Frame frame_;
  Normal3f ng_{0, 0, 1};
  float eta_ = 1;
  TransportMode mode_ = TransportMode::Radiance;
};

}  // namespace pbrtmedia
