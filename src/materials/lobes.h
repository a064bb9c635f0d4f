// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <variant>

#include "materials/fresnel_blend.h"
#include "materials/lambert.h"
#include "materials/local_frame.h"
#include "materials/microfacet_lobes.h"
#include "materials/oren_nayar.h"
#include "materials/rare_lobe.h"
#include "materials/specular.h"

namespace pbrtmedia {

/// Every scattering law. A new one is its header plus one word here or, better, in RareLobe.
using LobeModel =
    std::variant<LambertReflection, LambertTransmission, OrenNayar, SpecularReflection, SpecularTransmission,
                 FresnelSpecular, MicrofacetReflection, MicrofacetTransmission, FresnelBlend, RareLobe>;

/// A weighted scattering law in the shading frame: a small plain value. Directions are local.
class Lobe {
 public:
  Lobe() = default;  ///< black
  /// `weight` multiplies f: the reflectance, or 1 for laws that hold their own colours.
  Lobe(Rgb weight, const LobeModel& model)
      : model_(model), weight_(weight), flags_(std::visit([](const auto& m) { return flagsOf(m); }, model)) {}

  BsdfFlags flags() const { return flags_; }
  Rgb weight() const { return weight_; }
  const LobeModel& model() const { return model_; }
  void scale(Rgb s) { weight_ *= s; }
  void setFlag(BsdfFlags flag) { flags_ = flags_ | flag; }
  void clearFlag(BsdfFlags flag) { flags_ = without(flags_, flag); }

  /// 0 for specular laws.
  Rgb f(Vector3f wo, Vector3f wi) const {
    return weight_ * std::visit([&](const auto& m) { return m.f(wo, wi); }, model_);
  }
  float pdf(Vector3f wo, Vector3f wi) const {
    return std::visit([&](const auto& m) { return m.pdf(wo, wi); }, model_);
  }
  LobeSample sample(Vector3f wo, Point2f u) const {
    LobeSample s = std::visit([&](const auto& m) { return m.sample(wo, u); }, model_);
    s.f *= weight_;
    return s;
  }

 private:
  template <class Model>
  static constexpr BsdfFlags flagsOf(const Model&) {
    return Model::kFlags;
  }
  static BsdfFlags flagsOf(const RareLobe& lobe) { return lobe.flags(); }

  LobeModel model_;
  Rgb weight_;
  BsdfFlags flags_ = BsdfFlags::None;
};
static_assert(sizeof(Lobe) <= 64, "every surface point has eight; large laws are held elsewhere");

}  // namespace pbrtmedia
