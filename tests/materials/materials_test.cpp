// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "base/math.h"
#include "materials/material_test_support.h"
#include "materials/matte.h"
#include "materials/mirror.h"
#include "materials/mix.h"

namespace pbrtmedia {
namespace {

using namespace test;  // constants by the dozen

TEST(MatteMaterial, IsLambertWithoutSigma) {
  const Bsdf bsdf = evaluate(MatteMaterial({.kd = &kReddish, .sigma = &kZero}));
  EXPECT_EQ(bsdf.f(polar(20, 0), polar(60, 50)), Rgb(0.6f, 0.3f, 0.1f) * Rgb(kInvPi));
  EXPECT_EQ(bsdf.eta(), 1);
}

TEST(MatteMaterial, ClampsReflectanceAtZeroOnlyAndSigmaAtNinety) {
  EXPECT_EQ(evaluate(MatteMaterial({.kd = &kBright, .sigma = &kZero})).f({0, 0, 1}, {0, 0, 1}).r, 2 * kInvPi);
  EXPECT_EQ(evaluate(MatteMaterial({.kd = &kNegative, .sigma = &kZero})).lobeCount(), 0u);
  const FloatConstant ninety(90);
  const Vector3f wo = polar(60, 0), wi = polar(30, 20);
  EXPECT_EQ(evaluate(MatteMaterial({.kd = &kHalf, .sigma = &kHundred})).f(wo, wi),
            evaluate(MatteMaterial({.kd = &kHalf, .sigma = &ninety})).f(wo, wi));
}

TEST(PlasticMaterial, ReflectsTotallyBeyondFortyTwoDegreesOfHalfAngleAsPbrtDoes) {
  PlasticParams params = plasticParams();
  params.kd = &kBlack;
  const Bsdf bsdf = evaluate(PlasticMaterial(params));
  const float alpha = TrowbridgeReitz::alphaFromRoughness(0.1f);
  const MicrofacetReflection full{TrowbridgeReitz(alpha, alpha), NoFresnel{}};
  const auto fresnelAt = [&](float degrees, float side) {
    const Vector3f wo = side * polar(degrees, 0), wi = side * polar(degrees, 180);
    return bsdf.f(wo, wi).r / (0.25f * full.f(wo, wi).r);
  };
  EXPECT_NEAR(fresnelAt(0.01f, 1), 0.04f, 1e-5f);
  EXPECT_LT(fresnelAt(41, 1), 0.6f);
  EXPECT_NEAR(fresnelAt(42, 1), 1, 1e-5f);
  EXPECT_NEAR(fresnelAt(70, 1), 1, 1e-5f);
  // Seen from behind the normal the indices are as one expects.
  EXPECT_NEAR(fresnelAt(45, -1), fresnelDielectric(std::sqrt(0.5f), 1, 1.5f), 1e-5f);
}

TEST(PlasticMaterial, AddsDiffuseAndGlossy) {
  const PlasticMaterial both(plasticParams());
  PlasticParams onlyGlossy = plasticParams(), onlyDiffuse = plasticParams();
  onlyGlossy.kd = onlyDiffuse.ks = &kBlack;
  const Vector3f wo = polar(30, 0), wi = polar(20, 120);
  EXPECT_NEAR(evaluate(both).f(wo, wi).r, evaluate(PlasticMaterial(onlyGlossy)).f(wo, wi).r + 0.25f * kInvPi,
              1e-6f);
  EXPECT_EQ(evaluate(PlasticMaterial(onlyDiffuse)).f(wo, wi), Rgb(0.25f * kInvPi));
  EXPECT_EQ(both.maxLobes(), 2u);
  EXPECT_EQ(PlasticMaterial(onlyGlossy).maxLobes(), 1u);
}

TEST(PlasticMaterial, TakesRoughnessAsAlphaWithoutRemapping) {
  PlasticParams params = plasticParams();
  params.remapRoughness = false;
  const Bsdf bsdf = evaluate(PlasticMaterial(params));
  const auto& glossy = std::get<MicrofacetReflection>(bsdf.lobe(1).model());
  EXPECT_EQ(glossy.distribution.alphaX(), 0.1f);
  EXPECT_EQ(glossy.distribution.alphaY(), 0.1f);
}

TEST(GlassMaterial, IsOneLobeOrTwoWhenSmooth) {
  const GlassMaterial glass(glassParams());
  const Bsdf merged = evaluate(glass, true), split = evaluate(glass, false);
  ASSERT_EQ(merged.lobeCount(), 1u);
  ASSERT_EQ(split.lobeCount(), 2u);
  EXPECT_EQ(merged.eta(), 1.5f);
  EXPECT_EQ(merged.count(BsdfFlags::AllButSpecular), 0u);
  const Vector3f wo = polar(60, 0);
  const float f = fresnelDielectric(wo.z, 1, 1.5f);
  const BsdfSample reflected = split.sample(wo, {0, 0}, BsdfFlags::Specular | BsdfFlags::Reflection);
  EXPECT_NEAR(reflected.f.r * absDot(reflected.wi, Vector3f{0, 0, 1}), f, 1e-6f);
  const BsdfSample refracted = split.sample(wo, {0, 0}, BsdfFlags::Specular | BsdfFlags::Transmission);
  EXPECT_NEAR(refracted.f.r * std::abs(refracted.wi.z), (1 - f) / 2.25f, 1e-6f);
  EXPECT_EQ(refracted.pdf, 1);
}

TEST(GlassMaterial, IsRoughWhenOneRoughnessIsNotZero) {
  GlassParams params = glassParams();
  params.uRoughness = &kTenth;
  const Bsdf remapped = evaluate(GlassMaterial(params));
  ASSERT_EQ(remapped.lobeCount(), 2u);
  const auto& d = std::get<MicrofacetReflection>(remapped.lobe(0).model()).distribution;
  EXPECT_NEAR(d.alphaX(), 0.46176f, 1e-5f);
  EXPECT_NEAR(d.alphaY(), 0.04727f, 1e-5f);
  params.remapRoughness = false;
  const Bsdf plain = evaluate(GlassMaterial(params));
  EXPECT_EQ(std::get<MicrofacetTransmission>(plain.lobe(1).model()).distribution.alphaY(), 0.001f);
  const auto& transmission = std::get<MicrofacetTransmission>(remapped.lobe(1).model());
  EXPECT_EQ(transmission.etaA, 1);
  EXPECT_EQ(transmission.etaB, 1.5f);
}

TEST(GlassMaterial, LetsEverythingPassBetweenEqualIndices) {
  GlassParams params = glassParams();
  const FloatConstant one(1);
  params.eta = &one;
  params.uRoughness = params.vRoughness = &kTenth;
  const Vector3f wo = polar(40, 10);
  const BsdfSample s = evaluate(GlassMaterial(params)).sample(wo, {0.3f, 0.3f});
  EXPECT_NEAR(distance(s.wi, -wo), 0, 1e-6f);
  EXPECT_NEAR(s.f.r * wo.z / s.pdf, 1, 1e-6f);
}

TEST(MirrorMaterial, ReflectsTheSameAtEveryAngle) {
  const Bsdf bsdf = evaluate(MirrorMaterial({.kr = &kReddish}));
  for (const float theta : {0.0f, 40.0f, 85.0f}) {
    const Vector3f wo = polar(theta, 30);
    const BsdfSample s = bsdf.sample(wo, {0.3f, 0.4f});
    EXPECT_NEAR(s.f.r * wo.z, 0.6f, 1e-5f);
    EXPECT_NEAR(distance(s.wi, {-wo.x, -wo.y, wo.z}), 0, 1e-6f);
  }
}

TEST(MetalMaterial, IsAMicrofacetConductorWithOneRoughnessForBothAxes) {
  MetalParams params = metalParams();
  const Bsdf isotropic = evaluate(MetalMaterial(params));
  const Vector3f wo = polar(30, 0), wi = polar(30, 180);
  const float alpha = TrowbridgeReitz::alphaFromRoughness(0.1f);
  const Rgb expected =
      MicrofacetReflection{TrowbridgeReitz(alpha, alpha), ConductorFresnel{kCopperEta, kCopperK}}.f(wo, wi);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(isotropic.f(wo, wi)[c], expected[c], 1e-5f * expected[c]);
  params.uRoughness = &kFifth;
  const Bsdf anisotropic = evaluate(MetalMaterial(params));
  const auto& d = std::get<MicrofacetReflection>(anisotropic.lobe(0).model()).distribution;
  EXPECT_NEAR(d.alphaX(), 0.68384f, 1e-5f);
  EXPECT_NEAR(d.alphaY(), 0.46176f, 1e-5f);
}

TEST(SubstrateMaterial, IsTheFresnelBlend) {
  const Bsdf bsdf = evaluate(SubstrateMaterial(substrateParams()));
  const FresnelBlend blend{
      Rgb(0.5f), Rgb(0.5f),
      TrowbridgeReitz(TrowbridgeReitz::alphaFromRoughness(0.1f), TrowbridgeReitz::alphaFromRoughness(0.2f))};
  const Vector3f wo = polar(30, 0), wi = polar(50, 100);
  EXPECT_EQ(bsdf.f(wo, wi), blend.f(wo, wi));
  EXPECT_EQ(bsdf.lobeCount(), 1u);
}

TEST(TranslucentMaterial, SplitsIntoReflectedAndTransmittedLobes) {
  const TranslucentMaterial material(translucentParams());
  const Bsdf bsdf = evaluate(material);
  EXPECT_EQ(bsdf.lobeCount(), 4u);
  EXPECT_EQ(bsdf.eta(), 1.5f);
  const BsdfFlags diffuse = BsdfFlags::Diffuse | BsdfFlags::Reflection | BsdfFlags::Transmission;
  EXPECT_EQ(bsdf.f(polar(20, 0), polar(40, 0), diffuse), Rgb(0.125f * kInvPi));
  EXPECT_EQ(bsdf.f(polar(20, 0), -polar(40, 0), diffuse), Rgb(0.125f * kInvPi));
  TranslucentParams params = translucentParams();
  params.transmit = &kBlack;
  EXPECT_EQ(evaluate(TranslucentMaterial(params)).lobeCount(), 2u);
  EXPECT_EQ(TranslucentMaterial(params).maxLobes(), 2u);
}

TEST(UberMaterial, MultipliesAllLobesByTheOpacityAndLetsTheRestThrough) {
  const RgbConstant opacity(Rgb(0.25f, 0.5f, 1));
  UberParams params = uberParams();
  params.kr = params.kt = &kHalf;
  params.opacity = &opacity;
  const UberMaterial material(params);
  const Bsdf bsdf = evaluate(material);
  ASSERT_EQ(bsdf.lobeCount(), 5u);
  EXPECT_EQ(material.maxLobes(), 5u);
  EXPECT_EQ(bsdf.eta(), 1);
  EXPECT_EQ(bsdf.lobe(0).weight(), Rgb(0.75f, 0.5f, 0));
  EXPECT_EQ(bsdf.lobe(1).weight(), Rgb(0.0625f, 0.125f, 0.25f));
  EXPECT_EQ(bsdf.lobe(2).weight(), Rgb(0.0625f, 0.125f, 0.25f));
  EXPECT_EQ(bsdf.lobe(3).weight(), Rgb(0.125f, 0.25f, 0.5f));
  EXPECT_EQ(bsdf.lobe(4).weight(), Rgb(0.125f, 0.25f, 0.5f));
  const Vector3f wo = polar(50, 20);
  const BsdfSample through = bsdf.sample(wo, {0.1f, 0.5f});
  EXPECT_NEAR(distance(through.wi, -wo), 0, 1e-6f);
  EXPECT_NEAR(through.f.r * wo.z, 0.75f, 1e-6f);
  EXPECT_FLOAT_EQ(through.pdf, 0.2f);
}

TEST(UberMaterial, KeepsItsIndexWhenOpaque) {
  const UberMaterial material(uberParams());
  EXPECT_EQ(evaluate(material).eta(), 1.5f);
  EXPECT_EQ(evaluate(material).lobeCount(), 2u);
  EXPECT_EQ(material.maxLobes(), 2u);
}

TEST(UberMaterial, FallsBackFromVToUToRoughness) {
  UberParams params = uberParams();
  params.uRoughness = &kFifth;
  const Bsdf bsdf = evaluate(UberMaterial(params));
  const auto& d = std::get<MicrofacetReflection>(bsdf.lobe(1).model()).distribution;
  EXPECT_NEAR(d.alphaX(), 0.68384f, 1e-5f);
  EXPECT_NEAR(d.alphaY(), 0.68384f, 1e-5f);  // the u value, not roughness
  params.vRoughness = &kTenth;
  const Bsdf both = evaluate(UberMaterial(params));
  const auto& anisotropic = std::get<MicrofacetReflection>(both.lobe(1).model()).distribution;
  EXPECT_NEAR(anisotropic.alphaX(), 0.68384f, 1e-5f);
  EXPECT_NEAR(anisotropic.alphaY(), 0.46176f, 1e-5f);
}

TEST(MixMaterial, ShowsTheFirstMaterialAtAmountOne) {
  const MatteMaterial red({.kd = &kReddish, .sigma = &kZero}), grey({.kd = &kHalf, .sigma = &kZero});
  const Vector3f wo = polar(20, 0), wi = polar(40, 0);
  EXPECT_EQ(evaluate(MixMaterial(red, grey, kWhite)).f(wo, wi), Rgb(0.6f, 0.3f, 0.1f) * Rgb(kInvPi));
  EXPECT_EQ(evaluate(MixMaterial(red, grey, kBlack)).f(wo, wi), Rgb(0.5f * kInvPi));
  const Rgb quarter = evaluate(MixMaterial(red, grey, kQuarter)).f(wo, wi);
  EXPECT_NEAR(quarter.r, (0.25f * 0.6f + 0.75f * 0.5f) * kInvPi, 1e-6f);
  EXPECT_NEAR(quarter.b, (0.25f * 0.1f + 0.75f * 0.5f) * kInvPi, 1e-6f);
}

TEST(MixMaterial, WeighsEveryChannelAndClampsTheSecondWeightAtZero) {
  const MatteMaterial red({.kd = &kReddish, .sigma = &kZero}), grey({.kd = &kHalf, .sigma = &kZero});
  const Rgb f = evaluate(MixMaterial(red, grey, kBright)).f(polar(20, 0), polar(40, 0));  // (2, 0.5, 0.5)
  EXPECT_NEAR(f.r, 2 * 0.6f * kInvPi, 1e-6f);
  EXPECT_NEAR(f.g, 0.5f * (0.3f + 0.5f) * kInvPi, 1e-6f);
}

TEST(MixMaterial, KeepsTheIndexOfTheFirstMaterial) {
  const MatteMaterial matte({.kd = &kHalf, .sigma = &kZero});
  const GlassMaterial glass(glassParams());
  EXPECT_EQ(evaluate(MixMaterial(glass, matte, kHalf)).eta(), 1.5f);
  EXPECT_EQ(evaluate(MixMaterial(matte, glass, kHalf)).eta(), 1);
}

TEST(MixMaterial, ScalesCoatsAndMergedGlassAsAWhole) {
  const SubstrateMaterial substrate(substrateParams());
  const GlassMaterial glass(glassParams());
  const Bsdf mixed = evaluate(MixMaterial(substrate, glass, kQuarter));
  const Vector3f wo = polar(30, 0), wi = polar(50, 100);
  EXPECT_NEAR(mixed.f(wo, wi).r, 0.25f * evaluate(substrate).f(wo, wi).r, 1e-6f);
  const BsdfSample s = mixed.sample(wo, {0.99f, 0.5f});  // the glass lobe, refracted
  EXPECT_NEAR(s.f.r * std::abs(s.wi.z) / s.pdf, 2 * 0.75f / 2.25f, 1e-5f);
}

TEST(MixMaterial, RefusesMoreLobesThanABsdfHolds) {
  UberParams params = uberParams();
  params.kr = params.kt = params.opacity = &kHalf;
  const UberMaterial full(params);
  const TranslucentMaterial translucent(translucentParams());
  const UberMaterial opaque(uberParams());
  EXPECT_THROW(MixMaterial(full, translucent, kHalf), std::invalid_argument);  // 5 + 4
  const MixMaterial fits(translucent, opaque, kHalf);                          // 4 + 2
  EXPECT_EQ(fits.maxLobes(), 6u);
  EXPECT_EQ(evaluate(fits).lobeCount(), 6u);
  EXPECT_THROW(MixMaterial(fits, translucent, kHalf), std::invalid_argument);
  EXPECT_NO_THROW(MixMaterial(fits, opaque, kHalf));
}

TEST(DisneyMaterial, HasAsManyLobesAsItSaysAndNoMore) {
  const DisneyParams most = disneyParams();
  for (const bool isThin : {false, true}) {
    // Whatever is left out.
    for (unsigned without = 0; without < 256; ++without) {
      DisneyParams p = most;
      p.isThin = isThin;
      if (without & 1) p.color = &kBlack;
      if (without & 2) p.sheen = &kZero;
      if (without & 4) p.clearcoat = &kZero;
      if (without & 8) p.specTrans = &kZero;
      if (without & 16) p.metallic = &kOne;
      if (without & 32) p.flatness = &kZero;
      if (without & 64) p.diffTrans = &kZero;
      if (without & 128) p.scatterDistance = &kReddish;
      const DisneyMaterial material(p);
      EXPECT_EQ(evaluate(material).lobeCount(), material.maxLobes()) << isThin << without;
    }
  }
  DisneyParams plain = most;
  plain.sheen = plain.clearcoat = plain.specTrans = &kZero;
  const DisneyMaterial one(plain), another(plain);
  EXPECT_EQ(MixMaterial(one, another, kHalf).maxLobes(), 6u);
}

TEST(DisneyMaterial, HasAFiniteCoatWhateverItsGloss) {
  for (const float gloss : {-3.0f, 0.0f, 1.0f, 1.0089f, 1.5f}) {
    const ConstantTexture<float> texture(gloss);
    DisneyParams p = disneyParams();
    p.clearcoatGloss = &texture;
    const Bsdf bsdf = evaluate(DisneyMaterial(p));
    for (const Vector3f wo : {Vector3f(0, 0, 1), polar(40, 20), polar(85, 20)}) {
      const float f = bsdf.f(wo, {-wo.x, -wo.y, wo.z}).r;  // the mirror direction
      EXPECT_TRUE(f > 0 && std::isfinite(f)) << gloss << wo << f;
      for (int i = 0; i < 64; ++i) {
        const BsdfSample s = bsdf.sample(wo, {(static_cast<float>(i) + 0.5f) / 64, 0.999999f});
        EXPECT_TRUE(s.pdf >= 0 && std::isfinite(s.pdf) && std::isfinite(s.f.r)) << gloss << wo << i;
      }
    }
  }
}

TEST(MixMaterial, LetsLightBelowTheSurfaceByBothWhereTheFirstKnowsAWayOut) {
  const std::shared_ptr<const SubsurfaceMaterial> below = subsurfaceMaterial();
  const MatteMaterial matte({.kd = &kHalf, .sigma = &kZero});
  const auto waysDown = [](const Material& material) {
    const Bsdf bsdf = evaluate(material);
    std::size_t count = 0;
    for (std::size_t i = 0; i < bsdf.lobeCount(); ++i)
      count += any(bsdf.lobe(i).flags() & BsdfFlags::Subsurface) ? 1 : 0;
    return count;
  };
  ASSERT_EQ(waysDown(*below), 1u);
  EXPECT_EQ(waysDown(MixMaterial(*below, *below, kHalf)), 2u);
  EXPECT_EQ(waysDown(MixMaterial(*below, matte, kHalf)), 1u);
  EXPECT_EQ(waysDown(MixMaterial(matte, *below, kHalf)), 0u);
}

TEST(Materials, RefractImportanceWithoutTheSquaredIndices) {
  GlassParams glass = glassParams();
  UberParams uber = uberParams();
  uber.kd = uber.ks = &kBlack;
  uber.kt = &kWhite;
  const GlassMaterial smooth(glass);
  const UberMaterial opaque(uber);
  const MixMaterial mixed(smooth, opaque, kReddish);
  const BsdfFlags through = BsdfFlags::Transmission | BsdfFlags::Specular;
  const Vector3f wo = polar(35, 20);
  for (const Material* material :
       {static_cast<const Material*>(&smooth), static_cast<const Material*>(&opaque),
        static_cast<const Material*>(&mixed)}) {
    const BsdfSample radiance = evaluate(*material, false).sample(wo, {0.9f, 0.5f}, through);
    const BsdfSample importance =
        evaluate(*material, false, TransportMode::Importance).sample(wo, {0.9f, 0.5f}, through);
    ASSERT_GT(radiance.f.g, 0);
    EXPECT_EQ(importance.wi, radiance.wi);
    EXPECT_NEAR(importance.f.g, 2.25f * radiance.f.g, 1e-5f);
  }
  const BsdfSample merged = evaluate(smooth, true).sample(wo, {0.9f, 0.5f});
  EXPECT_NEAR(evaluate(smooth, true, TransportMode::Importance).sample(wo, {0.9f, 0.5f}).f.g,
              2.25f * merged.f.g, 1e-5f);
}

TEST(Materials, RefuseMissingTextures) {
  EXPECT_THROW(MatteMaterial({.kd = &kHalf}), std::invalid_argument);
  EXPECT_THROW(PlasticMaterial({}), std::invalid_argument);
  EXPECT_THROW(GlassMaterial({}), std::invalid_argument);
  EXPECT_THROW(MirrorMaterial({}), std::invalid_argument);
  EXPECT_THROW(MetalMaterial({.eta = &kEta, .k = &kK, .uRoughness = &kTenth}), std::invalid_argument);
  EXPECT_THROW(SubstrateMaterial({}), std::invalid_argument);
  EXPECT_THROW(TranslucentMaterial({}), std::invalid_argument);
  UberParams params = uberParams();
  params.roughness = nullptr;
  EXPECT_THROW(UberMaterial{params}, std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
