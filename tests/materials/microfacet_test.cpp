// SPDX-License-Identifier: BSD-2-Clause
#include "materials/microfacet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math.h"
#include "base/rng.h"
#include "base/warp.h"
#include "materials/bsdf_test_support.h"

namespace pbrtmedia {
namespace {

using test::polar;

TEST(TrowbridgeReitz, RemapsRoughnessAsTheTableSays) {
  // Scene-language reference 23.
  const struct {
    float roughness, alpha;
  } table[] = {{0, 0.04727f},    {0.001f, 0.04727f}, {0.01f, 0.13892f}, {0.05f, 0.31255f}, {0.1f, 0.46176f},
               {0.2f, 0.68384f}, {0.3f, 0.85704f},   {0.5f, 1.13083f},  {1, 1.62142f}};
  for (const auto& [roughness, alpha] : table) {
    EXPECT_NEAR(TrowbridgeReitz::alphaFromRoughness(roughness), alpha, 1e-5f) << roughness;
  }
}

TEST(TrowbridgeReitz, FloorsItsWidths) {
  EXPECT_EQ(TrowbridgeReitz(0, -1).alphaX(), 0.001f);
  EXPECT_EQ(TrowbridgeReitz(0, -1).alphaY(), 0.001f);
  EXPECT_EQ(TrowbridgeReitz(std::nanf(""), 0.5f).alphaX(), 0.001f);
}

TEST(TrowbridgeReitz, HasTheDensityOfTheFormula) {
  const TrowbridgeReitz d(0.3f, 0.6f);
  for (const float theta : {0.0f, 20.0f, 55.0f, 85.0f}) {
    for (const float phi : {0.0f, 30.0f, 90.0f, 200.0f}) {
      const double t = radians(static_cast<double>(theta)), p = radians(static_cast<double>(phi));
      const double e =
          std::pow(std::tan(t), 2) * (std::pow(std::cos(p) / 0.3, 2) + std::pow(std::sin(p) / 0.6, 2));
      const double expected =
          1 / (std::numbers::pi * 0.3 * 0.6 * std::pow(std::cos(t), 4) * std::pow(1 + e, 2));
      EXPECT_NEAR(d.density(polar(theta, phi)), expected, 2e-5 * expected) << theta << ' ' << phi;
    }
  }
}

TEST(TrowbridgeReitz, HasLambdaOfTheFormula) {
  const TrowbridgeReitz d(0.3f, 0.6f);
  EXPECT_EQ(d.lambda({0, 0, 1}), 0);
  EXPECT_NEAR(d.lambda(polar(60, 0)), 0.5 * (std::sqrt(1 + 0.09 * 3) - 1), 1e-6);
  EXPECT_NEAR(d.lambda(polar(60, 90)), 0.5 * (std::sqrt(1 + 0.36 * 3) - 1), 1e-6);
  EXPECT_EQ(d.masking({1, 0, 0}), 0);
  const Vector3f o = polar(40, 10), i = polar(70, 100);
  EXPECT_FLOAT_EQ(d.maskingShadowing(o, i), 1 / (1 + d.lambda(o) + d.lambda(i)));
}

// ∫ D(h) cosθ dω = 1: the facets cover the surface; ∫ G1(w) max(0, w·h) D(h) dω = cosθ_w: so seen from
// anywhere.
TEST(TrowbridgeReitz, ProjectsToTheSurface) {
  const TrowbridgeReitz d(0.4f, 0.7f);
  const Vector3f w = polar(65, 25);
  constexpr int kZ = 400, kPhi = 400;
  double covered = 0, seen = 0;
  for (int i = 0; i < kZ; ++i) {
    for (int j = 0; j < kPhi; ++j) {
      const float z = (static_cast<float>(i) + 0.5f) / kZ, r = std::sqrt(1 - z * z);
      const float phi = 2 * kPi * (static_cast<float>(j) + 0.5f) / kPhi;
      const Vector3f h{r * std::cos(phi), r * std::sin(phi), z};
      covered += static_cast<double>(d.density(h) * z);
      seen += static_cast<double>(d.density(h) * std::max(0.0f, dot(w, h)) * d.masking(w));
    }
  }
  const double cell = 2 * std::numbers::pi / (kZ * kPhi);
  EXPECT_NEAR(covered * cell, 1, 1e-3);
  EXPECT_NEAR(seen * cell, w.z, 1e-3);
}

TEST(TrowbridgeReitz, SamplesVisibleNormalsByTheirDensity) {
  for (const auto& [ax, ay] : {std::pair{0.2f, 0.5f}, std::pair{1.3f, 1.3f}}) {
    const TrowbridgeReitz d(ax, ay);
    std::uint64_t seed = 1;
    for (const Vector3f wo : {polar(0, 0), polar(50, 70), polar(85, 200), -polar(60, 30)}) {
      const test::ScatteringView view{
          [&](Point2f u) {
            const Vector3f h = d.sampleVisible(wo, u);
            return LobeSample{Rgb(1), h, d.pdfVisible(wo, h), BsdfFlags::Glossy};
          },
          // pdfVisible is even in h; only facets that face wo exist.
          [&](Vector3f h) { return h.z * wo.z > 0 && dot(wo, h) > 0 ? d.pdfVisible(wo, h) : 0; },
          [](Vector3f) { return Rgb(0); }};
      const test::ChiSquareTest result = test::directionTest(view, seed++);
      EXPECT_GT(result.pValue(), test::kMinPValue) << wo << ' ' << result;
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
