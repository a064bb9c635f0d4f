// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <variant>

#include "materials/disney_lobes.h"
#include "materials/fourier_scattering.h"
#include "materials/hair_fibre.h"
#include "materials/subsurface_exit.h"
#include "materials/transport_mode.h"

namespace pbrtmedia {

/// What importance does where a law tells radiance, of laws that are not reciprocal: wo and wi exchanged.
template <class Law>
struct Adjoint {
  static constexpr BsdfFlags kFlags = Law::kFlags;
  Law law;

  Rgb f(Vector3f wo, Vector3f wi) const { return law.f(wi, wo); }
  float pdf(Vector3f wo, Vector3f wi) const { return law.pdf(wo, wi); }
  LobeSample sample(Vector3f wo, Point2f u) const {
    LobeSample s = law.sample(wo, u);
    if (s.pdf > 0) s.f = f(wo, s.wi);
    return s;
  }
};

/// Scattering laws that few surfaces have. Among the common ones of `LobeModel` they are one alternative,
/// called out of line, so that those stay small and inlined; what is large of them (tables) is held by the
/// material.
class RareLobe {
 public:
  using Model = std::variant<DisneyDiffuse, DisneyFlatDiffuse, DisneyRetro, DisneySheen, DisneyReflection,
                             DisneyClearcoat, SubsurfaceExit, HairFibre, Adjoint<HairFibre>, StrandAdjoint,
                             FourierScattering, Adjoint<FourierScattering>>;

  explicit RareLobe(const Model& model) : model_(model) {}
  /// Of a law that is not reciprocal.
  template <class Law>
  RareLobe(const Law& law, TransportMode mode)
      : model_(mode == TransportMode::Radiance ? Model(law) : Model(Adjoint<Law>{law})) {}

  const Model& model() const { return model_; }
  BsdfFlags flags() const;
  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;

 private:
  Model model_;
};

}  // namespace pbrtmedia
