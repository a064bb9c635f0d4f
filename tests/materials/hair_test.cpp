// SPDX-License-Identifier: BSD-2-Clause
#include "materials/hair.h"

#include <gtest/gtest.h>

#include "materials/bsdf_test_support.h"
#include "materials/hair_fibre.h"

namespace pbrtmedia {
namespace {

using test::polar;

double albedo(const HairParams& params, Vector3f wo, std::uint64_t seed) {
  const Lobe lobe(Rgb(1), RareLobe(HairFibre(params)));
  return test::albedoBySampling(test::viewOf(lobe, wo), 0, seed, 4000).mean();
}

TEST(HairFibre, ReturnsAllLightItDoesNotAbsorb) {
  std::uint64_t seed = 1;
  for (const float roughness : {0.1f, 0.3f, 0.7f, 1.0f}) {
    for (const float h : {-0.9f, 0.0f, 0.4f}) {
      const HairParams clear{.h = h, .betaM = roughness, .betaN = roughness};
      for (const Vector3f wo : {polar(20, 30), polar(70, 100), -polar(80, 10)}) {
        // Every sample has the weight 1, so the mean has no noise.
        EXPECT_NEAR(albedo(clear, wo, seed++), 1, 2e-3) << roughness << h << wo;
      }
      // By uniform directions too: f itself integrates to 1, whatever the density of samples.
      const Lobe lobe(Rgb(1), RareLobe(HairFibre(clear)));
      const test::RunningStats uniform =
          test::albedoByUniform(test::viewOf(lobe, polar(40, 60)), 0, seed++, 100000);
      EXPECT_LT(std::abs(test::zTest(uniform, 1.0).z()), test::kMaxAbsZ) << roughness << h;
    }
  }
}

TEST(HairFibre, AbsorptionDarkensWhatGoesThrough) {
  HairParams params{.h = 0.3f, .sigmaA = Rgb(0.5f)};
  const double some = albedo(params, polar(30, 80), 5);
  params.sigmaA = Rgb(1e4f);
  const double all = albedo(params, polar(30, 80), 6);
  EXPECT_LT(some, 0.95);
  EXPECT_LT(all, 0.5 * some);
  // Of an opaque fibre there is reflection at its surface alone.
  const Vector3f wo = polar(30, 80);
  const float cosine = std::sqrt(1 - sqr(wo.x)) * std::sqrt(1 - sqr(0.3f));
  EXPECT_NEAR(all, static_cast<double>(fresnelDielectric(cosine, 1, 1.55f)), 2e-3);
}

TEST(HairFibre, TiltsTheHighlightTowardTheRoot) {
  // Reflection of light that comes straight onto the fibre leaves it 2 alpha away from straight.
  const HairParams params{.h = 0, .sigmaA = Rgb(1e4f), .betaM = 0.1f, .betaN = 0.3f, .alpha = 5};
  const HairFibre fibre(params);
  const auto at = [&](float degrees) {
    const float theta = radians(degrees);
    const Vector3f wi{std::sin(theta), 0, std::cos(theta)};
    return fibre.f({0, 0, 1}, wi).r * std::abs(wi.z);
  };
  EXPECT_GT(at(10), at(9));
  EXPECT_GT(at(10), at(11));
  EXPECT_GT(at(10), 5 * at(-10));
}

/// The same direction where the normal is turned by an angle about the fibre.
Vector3f turned(Vector3f w, float angle) {
  return {w.x, std::cos(angle) * w.y - std::sin(angle) * w.z, std::sin(angle) * w.y + std::cos(angle) * w.z};
}

TEST(StrandAdjoint, IsTheAdjointOfStrandsWhateverTheirNormal) {
  // What a strand scatters along a length of it: (cosine to the fibre of a) f(a, b) |cos b| of radiance is
  // that of importance with a and b exchanged, each in the frame that its ray gives the strand.
  const HairParams params{.h = 0.4f, .sigmaA = Rgb(0.2f, 0.5f, 1), .betaM = 0.4f, .betaN = 0.5f};
  const HairFibre fibre(params);
  const Lobe importance(Rgb(1), RareLobe(StrandAdjoint{fibre}));
  const auto cosine = [](Vector3f w) { return std::hypot(w.y, w.z); };
  int compared = 0;
  for (const Vector3f a : {polar(20, 30), polar(70, 100), -polar(80, 10)}) {
    for (const Vector3f b : {polar(50, 200), polar(10, 95), -polar(40, 130)}) {
      for (const float angle : {0.0f, 0.7f, 2.5f}) {
        const Vector3f a2 = turned(a, angle), b2 = turned(b, angle);
        const float radiance = cosine(a) * fibre.f(a, b).g * std::abs(b.z),
                    back = cosine(b) * importance.f(b2, a2).g * std::abs(a2.z);
        EXPECT_NEAR(back, radiance, 1e-4f * radiance + 1e-6f) << a << b << angle;
        EXPECT_EQ(importance.pdf(b2, a2), fibre.pdf(b2, a2));
        compared += radiance > 1e-3f ? 1 : 0;
      }
    }
  }
  EXPECT_GT(compared, 10);
}

TEST(HairFibre, IsFiniteForAnyIndex) {
  for (const float eta : {0.3f, 0.999f, 1.0f, 1.001f, 1.55f}) {
    for (const float h : {-1.0f, 0.0f, 0.5f, 1.0f}) {
      for (const Rgb sigmaA : {Rgb(0), Rgb(1e30f)}) {
        const HairFibre fibre({.h = h, .eta = eta, .sigmaA = sigmaA});
        for (const Vector3f wo : {Vector3f(0, 0, 1), Vector3f(1, 0, 0), polar(60, 10), polar(89.9f, 0)}) {
          const Rgb f = fibre.f(wo, polar(30, 60));
          EXPECT_TRUE(f.r >= 0 && std::isfinite(f.r)) << f << eta << h << wo;
          const float pdf = fibre.pdf(wo, polar(30, 60));
          EXPECT_TRUE(pdf >= 0 && std::isfinite(pdf)) << pdf << eta << h << wo;
          const LobeSample s = fibre.sample(wo, {0.3f, 0.6f});
          EXPECT_TRUE(s.pdf >= 0 && std::isfinite(s.pdf) && isFinite(s.wi)) << eta << h << wo;
        }
      }
    }
  }
}

TEST(HairFibre, AbsorptionOfAColourIsThatOfItsFit) {
  const Rgb sigmaA = hairAbsorption(Rgb(0.8f, 0.3f, 1), 0);
  EXPECT_NEAR(std::exp(-5.969f * std::sqrt(sigmaA.r)), 0.8f, 1e-5f);
  EXPECT_NEAR(std::exp(-5.969f * std::sqrt(sigmaA.g)), 0.3f, 1e-5f);
  EXPECT_EQ(sigmaA.b, 0);
  EXPECT_EQ(hairAbsorption(2, 1), Rgb(0.419f, 0.697f, 1.37f) * 2.0f + Rgb(0.187f, 0.4f, 1.05f));
}

TEST(HairMaterial, KnowsWhereOnTheFibreItIs) {
  const ConstantTexture<float> eta(1.55f), beta(0.3f), tilt(2);
  const ConstantTexture<Rgb> none(Rgb(0));
  const HairMaterial hair({.sigmaA = &none, .eta = &eta, .betaM = &beta, .betaN = &beta, .alpha = &tilt});
  SurfaceInteraction si = test::flatSurface();
  si.uv = {0.2f, 0.85f};
  const Vector3f wo = polar(20, 30), wi = polar(60, 200);
  EXPECT_EQ(hair.bsdf(si, TransportMode::Radiance, true).f(wo, wi),
            HairFibre({.h = 2 * 0.85f - 1}).f(wo, wi));
}

TEST(HairMaterial, IsTheAdjointOfWhatItLiesOn) {
  const ConstantTexture<float> eta(1.55f), beta(0.3f), tilt(2);
  const ConstantTexture<Rgb> none(Rgb(0));
  const HairMaterial hair({.sigmaA = &none, .eta = &eta, .betaM = &beta, .betaN = &beta, .alpha = &tilt});
  SurfaceInteraction si = test::flatSurface();
  si.uv = {0.2f, 0.85f};
  const Vector3f wo = polar(20, 30), wi = polar(60, 200);
  const HairFibre fibre({.h = 2 * 0.85f - 1});
  EXPECT_EQ(hair.bsdf(si, TransportMode::Importance, true).f(wo, wi), fibre.f(wi, wo));
  si.turnsToRays = true;
  EXPECT_EQ(hair.bsdf(si, TransportMode::Importance, true).f(wo, wi), StrandAdjoint{fibre}.f(wo, wi));
  EXPECT_EQ(hair.bsdf(si, TransportMode::Radiance, true).f(wo, wi), fibre.f(wo, wi));
}

}  // namespace
}  // namespace pbrtmedia
