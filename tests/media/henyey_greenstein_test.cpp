// SPDX-License-Identifier: BSD-2-Clause
#include "media/phase/henyey_greenstein.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/diagnostics.h"
#include "base/rng.h"
#include "base/warp.h"
#include "support/function_line.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

constexpr std::uint64_t kSeed = 20240609;

/// Pr{cosine to the direction of travel <= m}.
double cdf(double g, double m) {
  if (std::abs(g) < 1e-9) return (1 + m) / 2;
  return (1 - g * g) / (2 * g) * (1 / std::sqrt(1 + g * g - 2 * g * m) - 1 / (1 + g));
}

TEST(HenyeyGreenstein, HasTheValuesOfTheReference) {
  const HenyeyGreenstein phase(.5f);
  const Vector3f wo(0, 0, 1);
  EXPECT_NEAR(phase.evaluate(wo, {0, 0, -1}), .47746, 1e-5);  // straight ahead
  EXPECT_NEAR(phase.evaluate(wo, {0, 0, 1}), .01768, 1e-5);
  EXPECT_NEAR(phase.evaluate(wo, {0, 0, -1}) / phase.evaluate(wo, {0, 0, 1}), 27, 1e-4);
  EXPECT_FLOAT_EQ(HenyeyGreenstein(0).evaluate(wo, {.6f, 0, .8f}), kInv4Pi);
}

TEST(HenyeyGreenstein, IntegratesToOne) {
  for (const float g : {-.999f, -.9f, -.3f, 0.0f, 1e-4f, .5f, .9f, .999f}) {
    const HenyeyGreenstein phase(g);
    // Substituting the angle a = pi q² piles points up at the forward peak, mirrored for backward ones.
    const double integral = test::simpson(
        [&](double q) {
          const double a = std::numbers::pi * q * q * q, da = 3 * std::numbers::pi * q * q;
          const Vector3f wi(static_cast<float>(std::sin(a)), 0,
                            static_cast<float>(g > 0 ? -std::cos(a) : std::cos(a)));
          return phase.evaluate({0, 0, 1}, wi) * 2 * std::numbers::pi * std::sin(a) * da;
        },
        0, 1);
    EXPECT_NEAR(integral, 1, 2e-5) << g;
  }
}

TEST(HenyeyGreenstein, SamplesCosinesFromTheExactDistribution) {
  for (const float g : {-.999f, -.9f, -1e-3f, 0.0f, 1e-3f, .9f, .999f}) {
    const HenyeyGreenstein phase(g);
    const Vector3f wo = normalize(Vector3f(1, -2, .5f));
    constexpr int kBins = 50;
    std::vector<double> observed(kBins, 0.0), around(kBins, 0.0);
    const std::vector<double> expected(kBins, 400000.0 / kBins);
    const auto [s, t] = coordinateSystem(wo);
    Rng rng(kSeed);
    for (int n = 0; n < 400000; ++n) {
      const auto sample = phase.sample(wo, {rng.uniform(), rng.uniform()});
      ASSERT_NEAR(length(sample.wi), 1, 1e-6);
      ASSERT_EQ(sample.value, phase.evaluate(wo, sample.wi));
      // The cosine near ±1 from the chord, which keeps digits.
      const double ahead = lengthSquared(Vec3d(sample.wi) + Vec3d(wo)) / 2;
      const double m = ahead < 1 ? 1 - ahead : lengthSquared(Vec3d(sample.wi) - Vec3d(wo)) / 2 - 1;
      const auto bin = [](double u) {
        return static_cast<std::size_t>(std::clamp(u * kBins, 0.0, kBins - 1.0));
      };
      ++observed[bin(cdf(g, m))];
      const double phi = std::atan2(dot(sample.wi, t), dot(sample.wi, s));
      ++around[bin((phi / std::numbers::pi + 1) / 2)];
    }
    const auto cosines = test::chiSquareTest(observed, expected),
               angles = test::chiSquareTest(around, expected);
    EXPECT_GT(cosines.pValue(), test::kMinPValue) << g << ": " << cosines;
    EXPECT_GT(angles.pValue(), test::kMinPValue) << g << ": " << angles;
  }
}

TEST(HenyeyGreenstein, TheOtherSignOfGIsNoticedByTheTest) {
  const HenyeyGreenstein phase(.3f);
  Rng rng(kSeed);
  std::vector<double> values;
  for (int n = 0; n < 10000; ++n) {
    const auto sample = phase.sample({0, 0, 1}, {rng.uniform(), rng.uniform()});
    values.push_back(cdf(-.3, -double{sample.wi.z}));
  }
  EXPECT_LT(test::ksTestUniform(values).pValue(), test::kMinPValue);
}

TEST(HenyeyGreenstein, HasMeanCosineG) {
  for (const float g : {-.8f, 0.0f, .25f, .95f}) {
    const HenyeyGreenstein phase(g);
    const auto test = test::runZTest(
        [&](Rng& rng) {
          return -double{phase.sample({0, 0, 1}, {rng.uniform(), rng.uniform()}).wi.z};
        },
        double{g}, kSeed, 100000);
    EXPECT_LT(std::abs(test.z()), test::kMaxAbsZ) << test;
  }
}

TEST(HenyeyGreenstein, StaysFiniteAtTheEndsOfTheUnitSquare) {
  for (const float g : {-.999f, 0.0f, .999f, std::nextafter(1.0f, 0.0f), std::nextafter(-1.0f, 0.0f)}) {
    for (const float u : {0.0f, .5f, kOneMinusEpsilon}) {
      const auto sample = HenyeyGreenstein(g).sample({0, 1, 0}, {u, u});
      EXPECT_TRUE(isFinite(sample.wi)) << g << ' ' << u;
      EXPECT_TRUE(std::isfinite(sample.value) && sample.value >= 0) << g << ' ' << u << ' ' << sample.value;
    }
  }
}

TEST(HenyeyGreenstein, RefusesAnAsymmetryOutsideTheOpenInterval) {
  for (const float g : {1.0f, -1.0f, 2.0f, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_THROW(HenyeyGreenstein{g}, SceneError) << g;
  }
}

}  // namespace
}  // namespace pbrtmedia
