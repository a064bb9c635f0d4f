// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/math.h"
#include "materials/bsdf_test_support.h"
#include "materials/fourier_sample.h"
#include "materials/fourier_table.h"
#include "materials/lobes.h"

namespace pbrtmedia {
namespace {

using test::polar;

// One contract for every law that is not specular.

struct LobeCase {
  std::string name;
  Lobe lobe;
};

void PrintTo(const LobeCase& c, std::ostream* os) { *os << c.name; }

const TrowbridgeReitz kAnisotropic(0.25f, 0.5f);

const HairFibre kHair({.h = 0.4f, .sigmaA = Rgb(0.2f, 0.5f, 1), .betaM = 0.4f, .betaN = 0.5f});

const FourierTable& fourierTable() {
  static const FourierTable table =
      FourierTable::parse(test::FourierSample{.cosines = test::fourierCosines(8)}.bytes(), "t.bsdf");
  return table;
}

Lobe rare(const RareLobe::Model& model) { return {Rgb(0.8f, 0.6f, 0.3f), RareLobe(model)}; }

std::vector<LobeCase> lobeCases() {
  const ConductorFresnel copper{{0.2f, 0.9f, 1.1f}, {3.9f, 2.4f, 2.1f}};
  return {{"LambertReflection", Lobe({0.2f, 0.5f, 0.8f}, LambertReflection{})},
          {"LambertTransmission", Lobe({0.2f, 0.5f, 0.8f}, LambertTransmission{})},
          {"OrenNayar", Lobe(Rgb(0.7f), OrenNayar(25))},
          {"MicrofacetReflectionDielectric",
           Lobe(Rgb(0.9f), MicrofacetReflection{kAnisotropic, DielectricFresnel{1, 1.5f}})},
          {"MicrofacetReflectionConductor",
           Lobe(Rgb(1), MicrofacetReflection{TrowbridgeReitz(0.3f, 0.3f), copper})},
          {"MicrofacetReflectionWithoutFresnel",
           Lobe(Rgb(1), MicrofacetReflection{TrowbridgeReitz(0.8f, 0.2f), NoFresnel{}})},
          {"MicrofacetTransmission", Lobe(Rgb(0.8f), MicrofacetTransmission{kAnisotropic, 1, 1.5f})},
          {"MicrofacetTransmissionToThinner",
           Lobe(Rgb(0.8f), MicrofacetTransmission{TrowbridgeReitz(0.4f, 0.4f), 1.4f, 1})},
          {"FresnelBlend",
           Lobe(Rgb(1), FresnelBlend{Rgb(0.4f, 0.2f, 0.6f), Rgb(0.3f, 0.1f, 0.05f), kAnisotropic})},
          {"DisneyDiffuse", rare(DisneyDiffuse{})},
          {"DisneyFlatDiffuse", rare(DisneyFlatDiffuse{0.7f})},
          {"DisneyRetro", rare(DisneyRetro{0.6f})},
          {"DisneySheen", rare(DisneySheen{})},
          {"DisneyReflection", rare(DisneyReflection{kAnisotropic, Rgb(0.7f, 0.4f, 0.2f), 0.6f, 1.5f})},
          {"DisneyClearcoat", rare(DisneyClearcoat{0.2f})},
          {"SeparableMicrofacetTransmission",
           Lobe(Rgb(0.8f), MicrofacetTransmission{kAnisotropic, 1, 1.5f, TransportMode::Radiance, true})},
          {"SubsurfaceExit", rare(SubsurfaceExit(1.4f, false))},
          {"Hair", Lobe(Rgb(0.9f), RareLobe(kHair))},
          {"HairImportance", Lobe(Rgb(0.9f), RareLobe(kHair, TransportMode::Importance))},
          {"Fourier", rare(FourierScattering{&fourierTable()})}};
}

/// Laws with a direction of light: what is asked of pairs of directions does not hold.
bool isDirected(const Lobe& lobe) {
  const auto* rareLobe = std::get_if<RareLobe>(&lobe.model());
  return rareLobe != nullptr && (std::holds_alternative<HairFibre>(rareLobe->model()) ||
                                 std::holds_alternative<Adjoint<HairFibre>>(rareLobe->model()) ||
                                 std::holds_alternative<SubsurfaceExit>(rareLobe->model()) ||
                                 std::holds_alternative<FourierScattering>(rareLobe->model()));
}
bool isTwoSided(const Lobe& lobe) {
  return any(lobe.flags() & BsdfFlags::Reflection) && any(lobe.flags() & BsdfFlags::Transmission);
}

const std::vector<Vector3f> kViews{polar(5, 0), polar(45, 40), polar(80, 250), -polar(30, 130),
                                   -polar(70, 310)};

class SmoothLobe : public testing::TestWithParam<LobeCase> {};

INSTANTIATE_TEST_SUITE_P(All, SmoothLobe, testing::ValuesIn(lobeCases()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(SmoothLobe, SamplesItsDensity) {
  std::uint64_t seed = 100;
  for (const Vector3f wo : kViews) {
    const test::ChiSquareTest result = test::directionTest(test::viewOf(GetParam().lobe, wo), seed++);
    EXPECT_GT(result.pValue(), test::kMinPValue) << "wo " << wo << ": " << result;
  }
}

TEST_P(SmoothLobe, IntegratesToTheSameBySamplingAndByUniformDirections) {
  for (const Vector3f wo : kViews) {
    const test::ScatteringView view = test::viewOf(GetParam().lobe, wo);
    for (const std::size_t channel : {0u, 2u}) {
      const test::ZTest z = test::zTest(test::albedoBySampling(view, channel, 5, 20000),
                                        test::albedoByUniform(view, channel, 6, 100000));
      EXPECT_LT(std::abs(z.z()), test::kMaxAbsZ) << "wo " << wo << ": " << z;
    }
  }
}

TEST_P(SmoothLobe, ReturnsSamplesThatAgreeWithFAndPdf) {
  Rng rng(4);
  for (const Vector3f wo : kViews) {
    for (int i = 0; i < 500; ++i) {
      const float u = rng.uniform(), v = rng.uniform();
      const LobeSample s = GetParam().lobe.sample(wo, {u, v});
      if (!(s.pdf > 0)) continue;
      EXPECT_NEAR(length(s.wi), 1, 1e-5f);
      EXPECT_EQ(s.flags, GetParam().lobe.flags());
      EXPECT_EQ(s.pdf, GetParam().lobe.pdf(wo, s.wi));
      EXPECT_EQ(s.f, GetParam().lobe.f(wo, s.wi));
      if (isTwoSided(GetParam().lobe)) continue;
      EXPECT_EQ(isSameHemisphere(wo, s.wi), any(s.flags & BsdfFlags::Reflection));
    }
  }
}

TEST_P(SmoothLobe, IsReciprocalUpToTheSquaredIndex) {
  if (isDirected(GetParam().lobe)) GTEST_SKIP() << "a law that is not reciprocal";
  // f(wo, wi) eta_i² = f(wi, wo) eta_o² with the index of the side of each direction.
  float indexAbove = 1, indexBelow = 1;
  if (const auto* t = std::get_if<MicrofacetTransmission>(&GetParam().lobe.model())) {
    indexAbove = t->etaA;
    indexBelow = t->etaB;
  }
  const bool isReflection = any(GetParam().lobe.flags() & BsdfFlags::Reflection);
  const auto index2 = [&](Vector3f w) { return sqr(w.z > 0 ? indexAbove : indexBelow); };
  Rng rng(8);
  int compared = 0;
  for (int i = 0; i < 500; ++i) {
    Vector3f a = sampleUniformSphere({rng.uniform(), 0.3f}),
             b = sampleUniformSphere({rng.uniform(), rng.uniform()});
    if (isSameHemisphere(a, b) != isReflection) b.z = -b.z;
    const float there = GetParam().lobe.f(a, b).g * index2(b), back = GetParam().lobe.f(b, a).g * index2(a);
    // Near total reflection 1 - F is the root of a rounding error; what is left there is below this.
    if (!isReflection && there + back < 1e-4f) continue;
    EXPECT_NEAR(there, back, 1e-4f * (there + back) + 1e-7f) << a << b;
    compared += there > 0 ? 1 : 0;
  }
  EXPECT_GT(compared, 20);
}

TEST_P(SmoothLobe, ReturnsNoMoreEnergyThanItGets) {
  for (const Vector3f wo : kViews) {
    // Radiance grows by (eta_o/eta_i)² on its way into the denser side.
    float squaredIndices = 1;
    if (const auto* t = std::get_if<MicrofacetTransmission>(&GetParam().lobe.model())) {
      squaredIndices = sqr(wo.z > 0 ? t->etaB / t->etaA : t->etaA / t->etaB);
    }
    const test::RunningStats albedo = test::albedoBySampling(test::viewOf(GetParam().lobe, wo), 1, 9, 20000);
    EXPECT_LT(albedo.mean() * static_cast<double>(squaredIndices), 1 + 5 * albedo.standardError()) << wo;
  }
}

TEST(DirectionTest, RejectsADensityThatIsFivePercentOff) {
  const Lobe lobe(Rgb(1), LambertReflection{});
  EXPECT_LT(test::directionTest(test::viewOf(lobe, polar(30, 0)), 3, 0.95).pValue(), test::kMinPValue);
}

}  // namespace
}  // namespace pbrtmedia
