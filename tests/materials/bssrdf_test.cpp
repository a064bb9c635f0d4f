// SPDX-License-Identifier: BSD-2-Clause
#include "materials/bssrdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "base/rng.h"
#include "materials/bsdf_test_support.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

const SubsurfaceTable& table() {
  static const SubsurfaceTable t(0, 1.33f);
  return t;
}

/// ∫ 2π r value(r) dr over steps that grow with r.
template <class Value>
double overThePlane(const Value& value, double most) {
  constexpr int kSteps = 200000;
  constexpr double kLeast = 1e-7;
  const double factor = std::log(most / kLeast) / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double r = kLeast * std::exp((i + 0.5) * factor);
    sum += 2 * std::numbers::pi * r * static_cast<double>(value(static_cast<float>(r))) * r * factor;
  }
  return sum;
}

struct ProfileCase {
  std::string name;
  Bssrdf bssrdf;
  Rgb albedo;  ///< of the profile
};
std::vector<ProfileCase> cases() {
  const Rgb single(0.95f, 0.7f, 0.2f), extinction(3, 0.5f, 12);
  const Rgb effective(table().effectiveAlbedo(single.r), table().effectiveAlbedo(single.g),
                      table().effectiveAlbedo(single.b));
  return {{"Tabulated", Bssrdf(TabulatedProfile{&table(), extinction, single}, 1.33f), effective},
          {"Disney", Bssrdf(DisneyProfile{Rgb(0.9f, 0.5f, 0.2f), Rgb(0.1f, 0.3f, 2)}, 1.5f),
           Rgb(0.9f, 0.5f, 0.2f)}};
}

TEST(Bssrdf, IntegratesToItsAlbedoAndItsDensityToOne) {
  for (const ProfileCase& c : cases()) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(overThePlane([&](float r) { return c.bssrdf.pdfRadius(k, r); }, 1000), 1, 2e-3)
          << c.name << k;
      EXPECT_NEAR(overThePlane([&](float r) { return c.bssrdf.radial(r)[k]; }, 1000),
                  static_cast<double>(c.albedo[k]), 2e-3)
          << c.name << k;
    }
  }
}

TEST(Bssrdf, SamplesItsDensity) {
  for (const ProfileCase& c : cases()) {
    for (std::size_t k = 0; k < 3; ++k) {
      // Bins of equal share by counting, their masses by integration.
      constexpr int kBins = 12, kSamples = 40000;
      const double widest = static_cast<double>(c.bssrdf.reach(k));
      std::vector<double> observed(kBins + 1), expected(kBins + 1);
      Rng rng(40 + k);
      for (int i = 0; i < kSamples; ++i) {
        const double share = static_cast<double>(c.bssrdf.sampleRadius(k, rng.uniform())) / widest;
        ++observed[static_cast<std::size_t>(std::min(std::sqrt(share) * kBins, double{kBins}))];
      }
      double before = 0;
      for (int b = 1; b <= kBins; ++b) {
        const double until = widest * sqr(static_cast<double>(b) / kBins);
        const double mass = overThePlane([&](float r) { return c.bssrdf.pdfRadius(k, r); }, until);
        expected[static_cast<std::size_t>(b - 1)] = kSamples * (mass - before);
        before = mass;
      }
      expected.back() = kSamples * std::max(0.0, 1 - before);
      const test::ChiSquareTest result = test::chiSquareTest(observed, expected);
      EXPECT_GT(result.pValue(), test::kMinPValue) << c.name << k << ": " << result;
      for (double& e : expected) e *= 0.95;  // negative control
      EXPECT_LT(test::chiSquareTest(observed, expected).pValue(), test::kMinPValue) << c.name << k;
    }
  }
}

TEST(Bssrdf, ReachHoldsAllButAThousandth) {
  const ProfileCase c = cases()[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const double inside = overThePlane([&](float r) { return c.bssrdf.pdfRadius(k, r); },
                                       static_cast<double>(c.bssrdf.reach(k)));
    EXPECT_NEAR(inside, 1 - static_cast<double>(Bssrdf::kBeyondReach), 1e-4);
  }
}

TEST(SubsurfaceTable, HasAlbedosThatGrowUpToOne) {
  EXPECT_EQ(table().effectiveAlbedo(0), 0);
  float before = 0;
  for (float albedo = 0.05f; albedo < 1; albedo += 0.05f) {
    const float effective = table().effectiveAlbedo(albedo);
    EXPECT_GT(effective, before) << albedo;
    EXPECT_NEAR(table().albedoOf(effective), albedo, 1e-4f);
    before = effective;
  }
  EXPECT_LE(table().effectiveAlbedo(1), 1);
  EXPECT_GT(table().effectiveAlbedo(1), 0.99f);
  EXPECT_NEAR(table().albedoOf(1), 1, 1e-4f);
  EXPECT_EQ(table().albedoOf(-1), 0);
}

/// Photon beam diffusion for an extinction of 1, by quadrature along the beam: Habel et al. 2013.
double beamDiffusion(double albedo, double g, double eta, double r) {
  const double scattering = albedo * (1 - g), extinction = 1 - albedo + scattering;
  const double diffusion = (2 * (1 - albedo) + scattering) / (3 * extinction * extinction);
  const double decay = std::sqrt((1 - albedo) / diffusion), m1 = fresnelMoment1(eta),
               m2 = fresnelMoment2(eta);
  const double nearest = r * std::sqrt(eta * eta - 1), ze = 2 * diffusion * (1 + 3 * m2) / (1 - 2 * m1);
  double sum = 0;
  constexpr int kSteps = 100000;
  constexpr double kMost = 30, kStep = kMost / kSteps, kFourPi = 4 * std::numbers::pi;
  for (int i = 0; i < kSteps; ++i) {
    const double z = (i + 0.5) * kStep;
    {  // once
      const double t = nearest + z, d = std::hypot(t, r), cosine = t / d;
      const double phase = (1 - g * g) / (kFourPi * std::pow(1 + g * g + 2 * g * cosine, 1.5));
      const double out =
          1 - static_cast<double>(fresnelDielectric(static_cast<float>(-cosine), 1, static_cast<float>(eta)));
      sum += kStep * albedo * std::exp(-z - nearest - d) / (d * d) * phase * out * cosine;
    }
    // More often: a source at depth z and its mirror image.
    const double mirror = z + 2 * ze, dr = std::hypot(r, z), dv = std::hypot(r, mirror);
    const double fluence = (std::exp(-decay * dr) / dr - std::exp(-decay * dv) / dv) / (kFourPi * diffusion);
    const double flux = (z * (1 + decay * dr) * std::exp(-decay * dr) / (dr * dr * dr) +
                         mirror * (1 + decay * dv) * std::exp(-decay * dv) / (dv * dv * dv)) /
                        kFourPi;
    const double weight = scattering * scattering / extinction * (1 - std::exp(-2 * extinction * (dr + z)));
    sum +=
        kStep * std::exp(-extinction * z) * weight * (fluence * (1 - 2 * m1) / 4 + flux * (1 - 3 * m2) / 2);
  }
  return sum;
}

TEST(SubsurfaceTable, HoldsPhotonBeamDiffusion) {
  // At nodes of the grid, so that no spline is in between.
  for (const auto& [g, eta] : {std::pair(0.0f, 1.33f), std::pair(0.5f, 1.5f), std::pair(-0.3f, 1.2f)}) {
    const SubsurfaceTable of(g, eta);
    for (const int node : {1, 30, 60}) {
      const double albedo = std::expm1(-8.0 * node / 99) / std::expm1(-8.0);
      for (const int step : {10, 25, 40}) {
        const double r = 0.0025 * std::pow(1.2, step);
        const double truth = beamDiffusion(albedo, static_cast<double>(g), static_cast<double>(eta), r);
        EXPECT_NEAR(static_cast<double>(of.radial(static_cast<float>(albedo), static_cast<float>(r))) / truth,
                    1, 0.02)
            << g << ' ' << eta << ' ' << albedo << ' ' << r;
      }
    }
  }
}

TEST(SubsurfaceExit, SendsOutAllThatArrives) {
  for (const float eta : {1.0f, 1.33f, 1.5f, 2.0f}) {
    const Lobe exit(Rgb(1), RareLobe(SubsurfaceExit(eta, false)));
    const test::RunningStats albedo = test::albedoBySampling(test::viewOf(exit, {0, 0, 1}), 0, 7, 100000);
    EXPECT_NEAR(albedo.mean(), 1, 3e-3 + 5 * albedo.standardError()) << eta;  // 3e-3: of the polynomial
    const Lobe radiance(Rgb(1), RareLobe(SubsurfaceExit(eta, true)));
    const Vector3f wi = test::polar(30, 0);
    EXPECT_NEAR(radiance.f({0, 0, 1}, wi).r, sqr(eta) * exit.f({0, 0, 1}, wi).r, 1e-5f);
  }
}

TEST(Bsdf, TakesMarkedLobesAsEventsForThoseWhoAsk) {
  Bsdf bsdf(test::flatSurface(), TransportMode::Radiance);
  bsdf.add(Lobe(Rgb(0.5f), LambertReflection{}));
  Lobe through(Rgb(1), MicrofacetTransmission{TrowbridgeReitz(0.3f, 0.3f), 1, 1.5f});
  through.setFlag(BsdfFlags::Subsurface);
  bsdf.add(through);
  const Vector3f wo = test::polar(20, 0), below = -test::polar(15, 10), above = test::polar(50, 10);
  Bsdf plain = bsdf;
  plain.forgetSubsurface();
  EXPECT_GT(bsdf.f(wo, below).r, 0);
  EXPECT_EQ(bsdf.f(wo, below), plain.f(wo, below));
  EXPECT_EQ(bsdf.count(BsdfFlags::AllButSpecular), 2u);
  EXPECT_TRUE(any(bsdf.sample(wo, {0.9f, 0.4f}).flags & BsdfFlags::Subsurface));
  EXPECT_FALSE(any(plain.sample(wo, {0.9f, 0.4f}).flags & BsdfFlags::Subsurface));

  Bsdf separate = bsdf;
  separate.separateSubsurface();
  EXPECT_TRUE(separate.f(wo, below).isBlack());
  EXPECT_EQ(separate.pdf(wo, below), 0);
  EXPECT_EQ(separate.count(BsdfFlags::AllButSpecular), 1u);
  EXPECT_EQ(separate.f(wo, above), bsdf.f(wo, above));
  const BsdfSample s = separate.sample(wo, {0.9f, 0.4f});
  EXPECT_TRUE(any(s.flags & BsdfFlags::Subsurface) && any(s.flags & BsdfFlags::Specular));
  const LobeSample alone = through.sample(wo, {0.8f, 0.4f});
  EXPECT_NEAR(s.f.r * absDot(s.wi, separate.shadingNormal()) / s.pdf,
              2 * alone.f.r * std::abs(alone.wi.z) / alone.pdf, 1e-4f);
  EXPECT_FALSE(any(separate.sample(wo, {0.1f, 0.4f}).flags & BsdfFlags::Subsurface));
}

}  // namespace
}  // namespace pbrtmedia
