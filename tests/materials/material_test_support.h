// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "materials/bsdf_test_support.h"
#include "materials/disney.h"
#include "materials/glass.h"
#include "materials/hair.h"
#include "materials/metal.h"
#include "materials/plastic.h"
#include "materials/substrate.h"
#include "materials/subsurface.h"
#include "materials/translucent.h"
#include "materials/uber.h"
#include "textures/texture.h"

// Constant textures and the parameters of one typical material of each kind.

namespace pbrtmedia::test {

using RgbConstant = ConstantTexture<Rgb>;
using FloatConstant = ConstantTexture<float>;

inline const RgbConstant kBlack(Rgb(0)), kQuarter(Rgb(0.25f)), kHalf(Rgb(0.5f)), kWhite(Rgb(1)),
    kNegative(Rgb(-1));
inline const RgbConstant kReddish(Rgb(0.6f, 0.3f, 0.1f)), kBright(Rgb(2, 0.5f, 0.5f));
inline const RgbConstant kEta(kCopperEta), kK(kCopperK);
inline const FloatConstant kZero(0), kOne(1), kTenth(0.1f), kFifth(0.2f), kThirty(30), kGlassIndex(1.5f),
    kSomewhat(0.4f), kTwo(2), kHundred(100);

inline Bsdf evaluate(const Material& material, bool mergeSpecular = true,
                     TransportMode mode = TransportMode::Radiance) {
  SurfaceInteraction si = flatSurface();
  return material.bsdf(si, mode, mergeSpecular);
}

inline UberParams uberParams() {
  return {.kd = &kQuarter,
          .ks = &kQuarter,
          .kr = &kBlack,
          .kt = &kBlack,
          .opacity = &kWhite,
          .roughness = &kTenth,
          .eta = &kGlassIndex};
}
inline PlasticParams plasticParams() { return {.kd = &kQuarter, .ks = &kQuarter, .roughness = &kTenth}; }
inline GlassParams glassParams() {
  return {.kr = &kWhite, .kt = &kWhite, .eta = &kGlassIndex, .uRoughness = &kZero, .vRoughness = &kZero};
}
inline TranslucentParams translucentParams() {
  return {.kd = &kQuarter, .ks = &kQuarter, .reflect = &kHalf, .transmit = &kHalf, .roughness = &kTenth};
}
inline MetalParams metalParams() { return {.eta = &kEta, .k = &kK, .roughness = &kTenth}; }
/// Some of everything.
inline DisneyParams disneyParams() {
  return {.color = &kReddish,
          .metallic = &kFifth,
          .eta = &kGlassIndex,
          .roughness = &kSomewhat,
          .specularTint = &kFifth,
          .anisotropic = &kFifth,
          .sheen = &kSomewhat,
          .sheenTint = &kFifth,
          .clearcoat = &kSomewhat,
          .clearcoatGloss = &kTenth,
          .specTrans = &kSomewhat,
          .scatterDistance = &kBlack,
          .flatness = &kSomewhat,
          .diffTrans = &kSomewhat};
}
inline HairMaterialParams hairParams() {
  return {.color = &kReddish, .eta = &kGlassIndex, .betaM = &kSomewhat, .betaN = &kSomewhat, .alpha = &kTwo};
}
inline std::shared_ptr<const SubsurfaceMaterial> subsurfaceMaterial() {
  const SubsurfaceBoundary boundary{
      .kr = &kWhite, .kt = &kWhite, .uRoughness = &kTenth, .vRoughness = &kFifth};
  return std::make_shared<SubsurfaceMaterial>(boundary, SubsurfaceCoefficients{&kQuarter, &kWhite},
                                              std::make_shared<SubsurfaceTable>(0.0f, 1.33f));
}
inline SubstrateParams substrateParams() {
  return {.kd = &kHalf, .ks = &kHalf, .uRoughness = &kTenth, .vRoughness = &kFifth};
}

}  // namespace pbrtmedia::test
