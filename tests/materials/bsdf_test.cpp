// SPDX-License-Identifier: BSD-2-Clause
#include "materials/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math.h"
#include "materials/bsdf_test_support.h"

namespace pbrtmedia {
namespace {

using test::flatSurface;
using test::polar;

Bsdf twoSided() {
  Bsdf bsdf(flatSurface(), TransportMode::Radiance);
  bsdf.add(Lobe(Rgb(0.5f), LambertReflection{}));
  bsdf.add(Lobe(Rgb(0.25f), LambertTransmission{}));
  return bsdf;
}

TEST(Bsdf, WithoutLobesIsBlack) {
  const Bsdf bsdf(flatSurface(), TransportMode::Radiance);
  EXPECT_EQ(bsdf.count(), 0u);
  EXPECT_EQ(bsdf.f({0, 0, 1}, {0, 0, 1}), Rgb());
  EXPECT_EQ(bsdf.pdf({0, 0, 1}, {0, 0, 1}), 0);
  EXPECT_EQ(bsdf.sample({0, 0, 1}, {0.5f, 0.5f}).pdf, 0);
  EXPECT_EQ(Bsdf().sample({0, 0, 1}, {0.5f, 0.5f}).pdf, 0);
}

TEST(Bsdf, SumsLobesOfTheSideThatTheGeometricNormalSees) {
  const Bsdf bsdf = twoSided();
  EXPECT_EQ(bsdf.f(polar(20, 0), polar(40, 0)), Rgb(0.5f * kInvPi));
  EXPECT_EQ(bsdf.f(polar(20, 0), -polar(40, 0)), Rgb(0.25f * kInvPi));

  SurfaceInteraction tilted = flatSurface();
  tilted.shading.n = polar(40, 0);  // leans toward +x
  tilted.shading.dpdu = polar(130, 0);
  Bsdf leaning(tilted, TransportMode::Radiance);
  leaning.add(Lobe(Rgb(0.5f), LambertReflection{}));
  leaning.add(Lobe(Rgb(0.25f), LambertTransmission{}));
  // Below the shading plane but above the surface: reflection.
  const Vector3f low = polar(80, 180);
  ASSERT_LT(dot(low, tilted.shading.n), 0);
  EXPECT_EQ(leaning.f({0, 0, 1}, low), Rgb(0.5f * kInvPi));
  // Above the shading plane but below the surface: transmission.
  EXPECT_EQ(leaning.f({0, 0, 1}, polar(110, 0)), Rgb(0.25f * kInvPi));
}

TEST(Bsdf, MatchesLobesWhoseFlagsAreAllAllowed) {
  Bsdf bsdf = twoSided();
  bsdf.add(Lobe(Rgb(1), FresnelSpecular{}));
  EXPECT_EQ(bsdf.count(), 3u);
  EXPECT_EQ(bsdf.count(BsdfFlags::AllButSpecular), 2u);
  EXPECT_EQ(bsdf.count(BsdfFlags::Reflection | BsdfFlags::Diffuse | BsdfFlags::Specular), 1u);
  EXPECT_EQ(bsdf.count(BsdfFlags::Specular | BsdfFlags::Reflection | BsdfFlags::Transmission), 1u);
  EXPECT_EQ(bsdf.f(polar(20, 0), polar(40, 0), BsdfFlags::Glossy | BsdfFlags::Reflection), Rgb());
  const BsdfFlags diffuseReflection = BsdfFlags::Reflection | BsdfFlags::Diffuse;
  EXPECT_FLOAT_EQ(bsdf.pdf(polar(20, 0), polar(60, 0), diffuseReflection), 0.5f * kInvPi);
  EXPECT_FLOAT_EQ(bsdf.pdf(polar(20, 0), polar(60, 0)), 0.5f * kInvPi / 3);
}

TEST(Bsdf, PicksLobesUniformlyAndReusesTheNumber) {
  const Bsdf bsdf = twoSided();
  const Vector3f wo = polar(30, 10);
  const BsdfSample first = bsdf.sample(wo, {0.25f, 0.75f}), second = bsdf.sample(wo, {0.75f, 0.75f});
  const LobeSample stretched = Lobe(Rgb(1), LambertReflection{}).sample(wo, {0.5f, 0.75f});
  EXPECT_NEAR(distance(first.wi, stretched.wi), 0, 1e-6f);
  EXPECT_NEAR(distance(second.wi, {stretched.wi.x, stretched.wi.y, -stretched.wi.z}), 0, 1e-6f);
  EXPECT_FLOAT_EQ(first.pdf, 0.5f * stretched.pdf);
  EXPECT_EQ(first.flags, BsdfFlags::Reflection | BsdfFlags::Diffuse);
  EXPECT_EQ(second.flags, BsdfFlags::Transmission | BsdfFlags::Diffuse);
  EXPECT_EQ(bsdf.sample(wo, {kOneMinusEpsilon, 0.5f}).flags, second.flags);
}

TEST(Bsdf, ReturnsTheSumForSmoothSamplesAndTheLobeAloneForSpecularOnes) {
  Bsdf bsdf(flatSurface(), TransportMode::Radiance);
  bsdf.add(Lobe(Rgb(0.5f), LambertReflection{}));
  bsdf.add(Lobe(Rgb(0.25f), OrenNayar(30)));
  bsdf.add(Lobe(Rgb(0.9f), SpecularReflection{NoFresnel{}}));
  const Vector3f wo = polar(30, 10);
  for (const float u : {0.1f, 0.5f}) {
    const BsdfSample s = bsdf.sample(wo, {u, 0.3f});
    EXPECT_NEAR(s.f.r, bsdf.f(wo, s.wi).r, 1e-6f);
    EXPECT_NEAR(s.pdf, bsdf.pdf(wo, s.wi), 1e-6f);
  }
  const BsdfSample specular = bsdf.sample(wo, {0.9f, 0.3f});
  EXPECT_FLOAT_EQ(specular.pdf, 1.0f / 3);
  EXPECT_NEAR(specular.f.r * wo.z, 0.9f, 1e-6f);
  EXPECT_EQ(specular.flags, BsdfFlags::Reflection | BsdfFlags::Specular);
  // Light that is looked up does not see the mirror.
  EXPECT_EQ(bsdf.f(wo, specular.wi, BsdfFlags::Specular | BsdfFlags::Reflection), Rgb());
}

TEST(Bsdf, DropsSamplesThatTheGeometricNormalCallsTheOtherSide) {
  SurfaceInteraction si = flatSurface();
  si.shading.n = polar(60, 0);
  si.shading.dpdu = polar(150, 0);
  Bsdf bsdf(si, TransportMode::Radiance);
  bsdf.add(Lobe(Rgb(0.5f), LambertReflection{}));
  Rng rng(2);
  int below = 0;
  for (int i = 0; i < 200; ++i) {
    const BsdfSample s = bsdf.sample(polar(30, 0), {rng.uniform(), rng.uniform()});
    ASSERT_GT(s.pdf, 0);
    EXPECT_EQ(s.f, s.wi.z > 0 ? Rgb(0.5f * kInvPi) : Rgb());
    below += s.wi.z < 0 ? 1 : 0;
  }
  EXPECT_GT(below, 10);
}

/// A surface whose shading normal leans toward +x by 30 degrees.
Bsdf leaning(TransportMode mode) {
  SurfaceInteraction si = flatSurface();
  si.shading.n = polar(30, 0);
  si.shading.dpdu = polar(120, 0);
  Bsdf bsdf(si, mode, 1.5f);
  bsdf.add(Lobe(Rgb(0.5f), LambertReflection{}));
  bsdf.add(Lobe(Rgb(0.25f), LambertTransmission{}));
  bsdf.add(Lobe(Rgb(0.3f), MicrofacetReflection{TrowbridgeReitz(0.4f, 0.2f), DielectricFresnel{1, 1.5f}}));
  bsdf.add(Lobe(Rgb(0.8f), MicrofacetTransmission{TrowbridgeReitz(0.4f, 0.2f), 1, 1.5f, mode}));
  return bsdf;
}

TEST(Bsdf, OfImportanceIsTheAdjointOfThatOfRadianceUnderShadingNormalsToo) {
  // Power through the surface is measured with the geometric normal:
  // f*(wo, wi) |wi·ns| |wo·ng| = f(wi, wo) |wo·ns| |wi·ng|.
  const Bsdf radiance = leaning(TransportMode::Radiance), importance = leaning(TransportMode::Importance);
  const Normal3f ng{0, 0, 1}, ns = radiance.shadingNormal();
  Rng rng(3);
  int reflected = 0, transmitted = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector3f a = sampleUniformSphere({rng.uniform(), rng.uniform()}),
                   b = sampleUniformSphere({rng.uniform(), rng.uniform()});
    const float there = importance.f(a, b).g * absDot(b, ns) * absDot(a, ng),
                back = radiance.f(b, a).g * absDot(a, ns) * absDot(b, ng);
    EXPECT_NEAR(there, back, 2e-4f * (there + back) + 1e-6f) << a << b;
    EXPECT_EQ(importance.pdf(a, b), radiance.pdf(a, b));
    (isSameHemisphere(a, b) ? reflected : transmitted) += there > 0.01f ? 1 : 0;
  }
  EXPECT_GT(reflected, 50);
  EXPECT_GT(transmitted, 50);
}

TEST(Bsdf, SamplesImportanceWithItsOwnLaw) {
  const Bsdf importance = leaning(TransportMode::Importance);
  Rng rng(4);
  for (int i = 0; i < 200; ++i) {
    const Vector3f wo = polar(40, 200);
    const BsdfSample s = importance.sample(wo, {rng.uniform(), rng.uniform()});
    if (!(s.pdf > 0)) continue;
    const Rgb f = importance.f(wo, s.wi);
    EXPECT_NEAR(s.f.g, f.g, 1e-4f * f.g + 1e-6f) << s.wi;
  }
}

TEST(Bsdf, CorrectsMirrorsForImportanceToo) {
  Bsdf radiance = leaning(TransportMode::Radiance), importance = leaning(TransportMode::Importance);
  const Lobe mirror(Rgb(0.9f), SpecularReflection{NoFresnel{}});
  radiance.add(mirror);
  importance.add(mirror);
  const Vector3f wo = polar(50, 100);
  const BsdfFlags allowed = BsdfFlags::Specular | BsdfFlags::Reflection;
  const BsdfSample r = radiance.sample(wo, {}, allowed), i = importance.sample(wo, {}, allowed);
  EXPECT_EQ(r.wi, i.wi);
  EXPECT_NEAR(i.f.g, r.f.g * r.wi.z / wo.z, 1e-6f);  // the shading normal sees both directions alike
}

TEST(Bsdf, HasNoCorrectionWhereTheShadingNormalIsTheGeometricOne) {
  const Bsdf flat(flatSurface(), TransportMode::Importance);
  EXPECT_FLOAT_EQ(flat.shadingCorrection(polar(20, 10), polar(70, 100)), 1);
  EXPECT_EQ(flat.shadingCorrection(polar(20, 10), {1, 0, 0}), 0);
}

TEST(Bsdf, TakesLocalXAlongTheShadingTangent) {
  // Anisotropic facets: narrow along x = dp/du, so the lobe is wide across it.
  SurfaceInteraction si = flatSurface();
  si.shading.dpdu = {0, 3, 1};  // made orthogonal to the normal: +y
  Bsdf bsdf(si, TransportMode::Radiance);
  const Lobe lobe(Rgb(1), MicrofacetReflection{TrowbridgeReitz(0.1f, 0.6f), NoFresnel{}});
  bsdf.add(lobe);
  EXPECT_FLOAT_EQ(bsdf.f({0, 0, 1}, polar(40, 90)).r, lobe.f({0, 0, 1}, polar(40, 0)).r);
  EXPECT_FLOAT_EQ(bsdf.f({0, 0, 1}, polar(40, 0)).r, lobe.f({0, 0, 1}, polar(40, 90)).r);
  si.shading.dpdu = {0, 0, 0};  // no tangent: any frame, still finite
  Bsdf degenerate(si, TransportMode::Radiance);
  degenerate.add(lobe);
  EXPECT_GT(degenerate.f({0, 0, 1}, polar(10, 0)).r, 0);
}

TEST(Bsdf, ScalesAndDropsWhatBecomesBlack) {
  Bsdf bsdf = twoSided();
  bsdf.scale({0.5f, 1, 2});
  EXPECT_EQ(bsdf.lobe(0).weight(), Rgb(0.25f, 0.5f, 1));
  EXPECT_EQ(bsdf.lobeCount(), 2u);
  bsdf.scale(Rgb(0));
  EXPECT_EQ(bsdf.lobeCount(), 0u);
}

TEST(BsdfDeathTest, DiesPastItsMostLobes) {
  Bsdf bsdf(flatSurface(), TransportMode::Radiance);
  for (std::size_t i = 0; i < Bsdf::kMaxLobes; ++i) bsdf.add(Lobe(Rgb(0.1f), LambertReflection{}));
  EXPECT_DEATH(bsdf.add(Lobe(Rgb(0.1f), LambertReflection{})), "too many lobes");
}

}  // namespace
}  // namespace pbrtmedia
