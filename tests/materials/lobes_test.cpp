// SPDX-License-Identifier: BSD-2-Clause
#include "materials/lobes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math.h"
#include "base/warp.h"
#include "materials/bsdf_test_support.h"

namespace pbrtmedia {
namespace {

using test::polar;

TEST(LambertReflection, IsReflectanceOverPi) {
  const Lobe lobe({0.2f, 0.5f, 0.8f}, LambertReflection{});
  EXPECT_EQ(lobe.f(polar(10, 0), polar(50, 90)), Rgb(0.2f, 0.5f, 0.8f) * Rgb(kInvPi));
  EXPECT_FLOAT_EQ(lobe.pdf(polar(10, 0), polar(60, 90)), 0.5f * kInvPi);
  EXPECT_EQ(lobe.pdf(polar(10, 0), -polar(60, 90)), 0);
}

TEST(LambertReflection, HasItsReflectanceAsWeightOfEverySample) {
  Rng rng(1);
  const Lobe lobe(Rgb(0.5f), LambertReflection{});
  for (int i = 0; i < 100; ++i) {
    const LobeSample s = lobe.sample(polar(20, 0), {rng.uniform(), rng.uniform()});
    EXPECT_NEAR(s.f.r * s.wi.z / s.pdf, 0.5f, 1e-6f);
  }
}

TEST(OrenNayar, IsLambertWithoutRoughness) {
  const OrenNayar smooth(0);
  for (const float theta : {0.0f, 30.0f, 80.0f}) {
    EXPECT_EQ(smooth.f(polar(theta, 10), polar(40, 40)), Rgb(kInvPi)) << theta;
  }
}

TEST(OrenNayar, HasTheValueOfTheFormula) {
  const double sigma = radians(20.0), s2 = sigma * sigma;
  const double a = 1 - s2 / (2 * (s2 + 0.33)), b = 0.45 * s2 / (s2 + 0.09);
  const OrenNayar rough(20);
  // wo at 60°, wi at 30°, 45° apart: alpha 60°, beta 30°.
  const double expected =
      (a + b * std::cos(radians(45.0)) * std::sin(radians(60.0)) * std::tan(radians(30.0))) /
      std::numbers::pi;
  EXPECT_NEAR(rough.f(polar(60, 0), polar(30, 45)).r, expected, 1e-6);
  EXPECT_NEAR(rough.f(polar(30, 45), polar(60, 0)).r, expected, 1e-6);
  EXPECT_NEAR(rough.f(polar(60, 0), polar(30, 135)).r, a / std::numbers::pi, 1e-6);  // from behind: only A
}

TEST(SpecularReflection, MirrorsAndWeighsByTheCosine) {
  const Vector3f wo = polar(40, 20);
  const LobeSample s = Lobe(Rgb(0.9f), SpecularReflection{NoFresnel{}}).sample(wo, {0.5f, 0.5f});
  EXPECT_EQ(s.wi, Vector3f(-wo.x, -wo.y, wo.z));
  EXPECT_EQ(s.pdf, 1);
  EXPECT_NEAR(s.f.g * wo.z, 0.9f, 1e-6f);
  EXPECT_EQ(s.flags, BsdfFlags::Reflection | BsdfFlags::Specular);
  const LobeSample glass = Lobe(Rgb(1), SpecularReflection{DielectricFresnel{1, 1.5f}}).sample({0, 0, 1}, {});
  EXPECT_NEAR(glass.f.r, 0.04f, 1e-6f);
  const LobeSample below =
      Lobe(Rgb(1), SpecularReflection{DielectricFresnel{1, 1.5f}}).sample(-polar(60, 0), {});
  EXPECT_NEAR(below.f.r * std::abs(below.wi.z), 1, 1e-6f);  // total reflection from inside
  EXPECT_LT(below.wi.z, 0);
}

TEST(SpecularTransmission, RefractsAndScalesRadianceByTheSquaredIndices) {
  const Lobe lobe(Rgb(1), SpecularTransmission{1, 1.5f});
  const LobeSample in = lobe.sample({0, 0, 1}, {});
  EXPECT_NEAR(in.f.r, 0.96f / 2.25f, 1e-6f);
  EXPECT_EQ(in.wi, Vector3f(0, 0, -1));
  const LobeSample out = lobe.sample({0, 0, -1}, {});
  EXPECT_NEAR(out.f.r, 0.96f * 2.25f, 1e-6f);

  const Vector3f wo = polar(50, 130);
  const LobeSample s = lobe.sample(wo, {});
  EXPECT_NEAR(s.wi.x, -wo.x / 1.5f, 1e-6f);
  EXPECT_NEAR(s.wi.y, -wo.y / 1.5f, 1e-6f);
  EXPECT_NEAR(s.f.r * std::abs(s.wi.z), (1 - fresnelDielectric(wo.z, 1, 1.5f)) / 2.25f, 1e-6f);
  EXPECT_EQ(lobe.sample(-polar(45, 0), {}).pdf, 0);  // total reflection
}

TEST(SpecularTransmission, GoesStraightThroughEqualIndices) {
  const Vector3f wo = polar(77, 31);
  const LobeSample s = Lobe(Rgb(0.25f), SpecularTransmission{1, 1}).sample(wo, {});
  EXPECT_EQ(s.wi, -wo);
  EXPECT_NEAR(s.f.r * wo.z, 0.25f, 1e-6f);
}

TEST(FresnelSpecular, ChoosesReflectionWithProbabilityF) {
  const Vector3f wo = polar(60, 0);
  const float f = fresnelDielectric(wo.z, 1, 1.5f);
  const Lobe lobe(Rgb(1), FresnelSpecular{Rgb(0.5f), Rgb(0.25f), 1, 1.5f});
  EXPECT_EQ(lobe.flags(), BsdfFlags::Reflection | BsdfFlags::Transmission | BsdfFlags::Specular);
  const LobeSample reflected = lobe.sample(wo, {0.999f * f, 0});
  EXPECT_EQ(reflected.pdf, f);
  EXPECT_NEAR(reflected.f.r * reflected.wi.z / reflected.pdf, 0.5f, 1e-6f);
  EXPECT_EQ(reflected.flags, BsdfFlags::Specular | BsdfFlags::Reflection);
  const LobeSample refracted = lobe.sample(wo, {1.001f * f, 0});
  EXPECT_EQ(refracted.pdf, 1 - f);
  EXPECT_NEAR(refracted.f.r * std::abs(refracted.wi.z) / refracted.pdf, 0.25f / 2.25f, 1e-6f);
  EXPECT_EQ(refracted.flags, BsdfFlags::Specular | BsdfFlags::Transmission);
  EXPECT_EQ(lobe.sample(-polar(60, 0), {kOneMinusEpsilon, 0}).flags,
            BsdfFlags::Specular | BsdfFlags::Reflection);
}

TEST(MicrofacetReflection, HasTheTorranceSparrowValue) {
  const TrowbridgeReitz d(0.4f, 0.2f);
  const Vector3f wo = polar(30, 20), wi = polar(50, 100), h = normalize(wo + wi);
  const Rgb f = MicrofacetReflection{d, DielectricFresnel{1, 1.5f}}.f(wo, wi);
  const float expected =
      d.density(h) * d.maskingShadowing(wo, wi) * fresnelDielectric(dot(wi, h), 1, 1.5f) / (4 * wo.z * wi.z);
  EXPECT_NEAR(f.r, expected, 1e-5f * expected);
}

TEST(MicrofacetReflection, LosesLittleEnergyWhenItIsSmooth) {
  const Lobe lobe(Rgb(1), MicrofacetReflection{TrowbridgeReitz(0.03f, 0.03f), NoFresnel{}});
  for (const float theta : {0.0f, 30.0f, 60.0f}) {
    EXPECT_NEAR(test::albedoBySampling(test::viewOf(lobe, polar(theta, 10)), 0, 2, 20000).mean(), 1, 5e-3)
        << theta;
  }
}

TEST(MicrofacetTransmission, KeepsTheEnergyOfGlassTogetherWithReflection) {
  const TrowbridgeReitz d(0.05f, 0.05f);
  const Lobe reflection(Rgb(1), MicrofacetReflection{d, DielectricFresnel{1, 1.5f}});
  const Lobe transmission(Rgb(1), MicrofacetTransmission{d, 1, 1.5f});
  for (const Vector3f wo : {polar(10, 0), polar(60, 0), -polar(20, 0), -polar(35, 0)}) {
    const double scale = wo.z > 0 ? 2.25 : 1 / 2.25;
    const double r = test::albedoBySampling(test::viewOf(reflection, wo), 0, 2, 40000).mean();
    const double t = test::albedoBySampling(test::viewOf(transmission, wo), 0, 3, 40000).mean();
    EXPECT_NEAR(r + t * scale, 1, 1e-2) << wo;
  }
}

TEST(MicrofacetTransmission, LosesNoImportanceTogetherWithReflection) {
  const TrowbridgeReitz d(0.05f, 0.05f);
  const Lobe reflection(Rgb(1), MicrofacetReflection{d, DielectricFresnel{1, 1.5f}});
  const Lobe transmission(Rgb(1), MicrofacetTransmission{d, 1, 1.5f, TransportMode::Importance});
  for (const Vector3f wo : {polar(10, 0), polar(60, 0), -polar(20, 0), -polar(35, 0)}) {
    const double r = test::albedoBySampling(test::viewOf(reflection, wo), 0, 2, 40000).mean();
    const double t = test::albedoBySampling(test::viewOf(transmission, wo), 0, 3, 40000).mean();
    EXPECT_NEAR(r + t, 1, 1e-2) << wo;
  }
}

/// What a refracting lobe lets through of radiance from wi to wo it lets through of importance from wo to wi:
/// the same but for the solid angle of the pencil, which radiance is per and importance is not.
void expectAdjointRefraction(const LobeModel& radiance, const LobeModel& importance, Point2f u) {
  for (const Vector3f wo : {polar(0, 0), polar(40, 30), polar(75, 200), -polar(25, 30), -polar(38, 100)}) {
    const LobeSample there = Lobe(Rgb(0.7f), radiance).sample(wo, u);
    ASSERT_GT(there.pdf, 0);
    ASSERT_TRUE(any(there.flags & BsdfFlags::Transmission));
    const LobeSample back = Lobe(Rgb(0.7f), importance).sample(there.wi, u);
    ASSERT_GT(back.pdf, 0);
    EXPECT_NEAR(distance(back.wi, wo), 0, 2e-6f);
    const float indices2 = sqr(wo.z > 0 ? 1.5f : 1 / 1.5f);  // (eta_i/eta_o)²
    EXPECT_NEAR(back.f.g * std::abs(back.wi.z), there.f.g * std::abs(there.wi.z) * indices2, 3e-6f) << wo;
    EXPECT_NEAR(back.pdf, there.pdf, 3e-6f);
  }
}

TEST(SpecularTransmission, OfImportanceIsTheAdjointOfThatOfRadiance) {
  expectAdjointRefraction(SpecularTransmission{1, 1.5f},
                          SpecularTransmission{1, 1.5f, TransportMode::Importance}, {});
}

TEST(FresnelSpecular, OfImportanceIsTheAdjointOfThatOfRadiance) {
  const FresnelSpecular radiance{Rgb(0.5f), Rgb(0.25f), 1, 1.5f};
  FresnelSpecular importance = radiance;
  importance.mode = TransportMode::Importance;
  expectAdjointRefraction(radiance, importance, {0.99f, 0});
  // Reflection is the same for both.
  EXPECT_EQ(Lobe(Rgb(1), radiance).sample(polar(60, 0), {0, 0}).f,
            Lobe(Rgb(1), importance).sample(polar(60, 0), {0, 0}).f);
}

TEST(MicrofacetTransmission, OfImportanceIsTheAdjointOfThatOfRadiance) {
  for (const Vector2f indices : {Vector2f{1, 1.5f}, Vector2f{1.4f, 1}}) {
    const MicrofacetTransmission radiance{TrowbridgeReitz(0.25f, 0.5f), indices.x, indices.y};
    MicrofacetTransmission importance = radiance;
    importance.mode = TransportMode::Importance;
    Rng rng(8);
    int compared = 0;
    for (int i = 0; i < 500; ++i) {
      const Vector3f a = sampleUniformSphere({rng.uniform(), rng.uniform()});
      Vector3f b = sampleUniformSphere({rng.uniform(), rng.uniform()});
      if (isSameHemisphere(a, b)) b.z = -b.z;
      const float there = radiance.f(a, b).g, back = importance.f(b, a).g;
      EXPECT_EQ(radiance.pdf(a, b), importance.pdf(a, b));
      if (there + back < 1e-4f) continue;  // near total reflection 1 - F is the root of a rounding error
      EXPECT_NEAR(there, back, 1e-4f * (there + back) + 1e-7f) << a << b;
      ++compared;
    }
    EXPECT_GT(compared, 20);
  }
}

TEST(MicrofacetTransmission, ApproachesSpecularTransmission) {
  const Lobe smooth(Rgb(1), SpecularTransmission{1, 1.5f});
  const Lobe rough(Rgb(1), MicrofacetTransmission{TrowbridgeReitz(0.005f, 0.005f), 1, 1.5f});
  for (const Vector3f wo : {polar(40, 30), -polar(25, 30)}) {
    const LobeSample s = smooth.sample(wo, {});
    EXPECT_NEAR(test::albedoBySampling(test::viewOf(rough, wo), 0, 4, 20000).mean(), s.f.r * std::abs(s.wi.z),
                5e-3);
  }
}

TEST(FresnelBlend, HasTheValueOfTheFormula) {
  const TrowbridgeReitz d(0.3f, 0.5f);
  const Rgb kd(0.4f, 0.2f, 0.6f), ks(0.3f, 0.1f, 0.05f);
  const Vector3f wo = polar(30, 20), wi = polar(50, 100), h = normalize(wo + wi);
  const Rgb found = FresnelBlend{kd, ks, d}.f(wo, wi);
  for (std::size_t c = 0; c < 3; ++c) {
    const double diffuse = 28 / (23 * std::numbers::pi) * static_cast<double>(kd[c] * (1 - ks[c])) *
                           (1 - std::pow(1 - 0.5 * static_cast<double>(wi.z), 5)) *
                           (1 - std::pow(1 - 0.5 * static_cast<double>(wo.z), 5));
    const double schlick = static_cast<double>(ks[c]) + (1 - static_cast<double>(ks[c])) *
                                                            std::pow(1 - static_cast<double>(dot(wi, h)), 5);
    const double specular = static_cast<double>(d.density(h)) * schlick /
                            (4 * static_cast<double>(dot(wi, h) * std::max(wi.z, wo.z)));
    EXPECT_NEAR(found[c], diffuse + specular, 1e-5 * (diffuse + specular));
  }
}

TEST(FresnelBlend, IsDiffuseWithoutSpecular) {
  // Ks = 0 at normal incidence with h = n: Schlick's term vanishes too.
  const Rgb f = FresnelBlend{Rgb(0.5f), Rgb(0), TrowbridgeReitz(0.3f, 0.3f)}.f({0, 0, 1}, {0, 0, 1});
  EXPECT_NEAR(f.r, 28 / (23 * kPi) * 0.5f * sqr(1 - 0.03125f), 1e-6f);
}

TEST(Lobe, MultipliesByItsWeight) {
  Lobe lobe(Rgb(0.5f), LambertReflection{});
  lobe.scale({1, 2, 0});
  EXPECT_EQ(lobe.weight(), Rgb(0.5f, 1, 0));
  EXPECT_EQ(lobe.f({0, 0, 1}, {0, 0, 1}), Rgb(0.5f, 1, 0) * Rgb(kInvPi));
  EXPECT_EQ(lobe.sample({0, 0, 1}, {0.5f, 0.5f}).f, Rgb(0.5f, 1, 0) * Rgb(kInvPi));
}

TEST(Lobe, IsSmallEnoughToBeMadePerHit) { EXPECT_LE(sizeof(Lobe), 64u); }

}  // namespace
}  // namespace pbrtmedia
