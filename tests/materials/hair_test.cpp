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

}  // namespace
}  // namespace pbrtmedia
