// SPDX-License-Identifier: BSD-2-Clause
#include "textures/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "base/rng.h"
#include "textures/fbm.h"
#include "textures/marble.h"
#include "textures/texture_test_support.h"
#include "textures/windy.h"
#include "textures/wrinkled.h"

namespace pbrtmedia {
namespace {

using test::atPoint;

constexpr Point3f kPoint{0.37f, -1.62f, 5.81f};

TEST(Noise, IsExactlyZeroAtLatticePoints) {
  for (int x = -3; x < 260; x += 7) {
    for (int y = -300; y < 300; y += 61) {
      EXPECT_EQ(noise({static_cast<float>(x), static_cast<float>(y), 5}), 0) << x << ' ' << y;
    }
  }
}

TEST(Noise, HasTheValuesOfTheFormulaInDoublePrecision) {
  // Computed outside from the definition in the scene-language reference 14.4.
  const struct {
    Point3f p;
    float value;
  } cases[] = {{{0.5f, 0.5f, 0.5f}, -0.125f},
               {{0.25f, 0.5f, 0.75f}, -0.0687942505f},
               {{1.5f, 2.25f, -3.125f}, 0.213621333f},
               {{-0.5f, -0.5f, -0.5f}, -0.375f},
               {{100.75f, 200.5f, 300.25f}, -0.464902401f},
               {{255.5f, 255.5f, 255.5f}, -0.375f},
               {{3.7f, 0.1f, 9.9f}, -0.432086608f}};
  for (const auto& c : cases) EXPECT_NEAR(noise(c.p), c.value, 2e-6f) << c.p;
}

TEST(Noise, StaysBetweenMinusOneAndOneAndHasBothSigns) {
  Rng rng(3);
  float lo = 0, hi = 0;
  for (int i = 0; i < 200000; ++i) {
    const float v = noise({1000 * rng.uniform() - 500, 1000 * rng.uniform(), 1000 * rng.uniform()});
    lo = std::min(lo, v);
    hi = std::max(hi, v);
  }
  EXPECT_GE(lo, -1);
  EXPECT_LE(hi, 1);
  EXPECT_LT(lo, -0.7f);
  EXPECT_GT(hi, 0.7f);
}

TEST(Noise, RepeatsAfter256CellsOnEveryAxis) {
  const Point3f p{0.25f, 0.5f, 7.125f};
  const float value = noise(p);
  ASSERT_NE(value, 0);
  for (const float period : {256.0f, -256.0f, 768.0f}) {
    EXPECT_EQ(noise(p + Vector3f{period, 0, 0}), value);
    EXPECT_EQ(noise(p + Vector3f{0, period, 0}), value);
    EXPECT_EQ(noise(p + Vector3f{0, 0, period}), value);
    EXPECT_NE(noise(p + Vector3f{0.5f * period, 0, 0}), value);
  }
}

TEST(Noise, HasTheTwelveEdgeDirectionsAsGradientsAtLatticePoints) {
  std::set<std::vector<int>> seen;
  constexpr float kStep = 1e-3f;
  for (int x = 0; x < 16; ++x) {
    for (int y = 0; y < 16; ++y) {
      const Point3f p{static_cast<float>(x), static_cast<float>(y), 2};
      std::vector<int> gradient;
      int zeros = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Vector3f d;
        d[axis] = kStep;
        const float slope = (noise(p + d) - noise(p - d)) / (2 * kStep);
        gradient.push_back(static_cast<int>(std::lround(slope)));
        EXPECT_NEAR(slope, static_cast<float>(gradient.back()), 2e-2f);
        zeros += gradient.back() == 0 ? 1 : 0;
      }
      EXPECT_EQ(zeros, 1) << p;
      seen.insert(gradient);
    }
  }
  EXPECT_EQ(seen.size(), 12u);
}

TEST(Noise, IsZeroForHugeAndNonFiniteCoordinates) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float bad : {3e9f, -1e30f, kInfinity, -kInfinity, nan}) {
    EXPECT_EQ(noise({bad, 0.5f, 0.5f}), 0);
    EXPECT_EQ(noise({0.5f, 0.5f, bad}), 0);
  }
}

float octave(int i, Point3f p) { return noise(std::pow(1.99f, static_cast<float>(i)) * p); }

TEST(Fbm, SumsAllOctavesWithoutAFootprint) {
  float expected = 0;
  for (int i = 0; i < 4; ++i) expected += std::pow(0.5f, static_cast<float>(i)) * octave(i, kPoint);
  EXPECT_NEAR(fbm(kPoint, {}, {}, {.octaves = 4, .roughness = 0.5f}), expected, 1e-5f);
  EXPECT_EQ(fbm(kPoint, {}, {}, {.octaves = 0, .roughness = 0.5f}), 0);
}

TEST(Fbm, LeavesOutOctavesFinerThanTheFootprint) {
  const FractalParams params{.octaves = 8, .roughness = 0.7f};
  // n = -1 - log2 |dp/dx|; the longer of the two steps counts.
  EXPECT_NEAR(fbm(kPoint, {0x1p-4f, 0, 0}, {0, 0x1p-6f, 0}, params),
              octave(0, kPoint) + 0.7f * octave(1, kPoint) + 0.49f * octave(2, kPoint), 1e-5f);
  // n = 2.5: smoothstep(0.3, 0.7, 0.5) = 1/2.
  EXPECT_NEAR(fbm(kPoint, {}, {0, std::exp2(-3.5f), 0}, params),
              octave(0, kPoint) + 0.7f * octave(1, kPoint) + 0.5f * 0.49f * octave(2, kPoint), 1e-5f);
  EXPECT_EQ(fbm(kPoint, {3, 0, 0}, {}, params), 0);
}

TEST(Turbulence, ReplacesFadedOctavesByTheirMean) {
  const FractalParams params{.octaves = 5, .roughness = 0.5f};
  const float three =
      std::abs(octave(0, kPoint)) + 0.5f * std::abs(octave(1, kPoint)) + 0.25f * std::abs(octave(2, kPoint));
  // n = 3: the octave at 3 counts 0.2 as the partial one, and once more as the first of those left out.
  EXPECT_NEAR(turbulence(kPoint, {0x1p-4f, 0, 0}, {}, params), three + 0.2f * (0.125f + 0.125f + 0.0625f),
              1e-5f);
  // All octaves: the partial one after the last counts 0.2.
  EXPECT_NEAR(turbulence(kPoint, {}, {}, {.octaves = 3, .roughness = 0.5f}), three + 0.2f * 0.125f, 1e-5f);
}

TEST(Turbulence, BlendsThePartialOctave) {
  const FractalParams params{.octaves = 3, .roughness = 0.5f};
  const float partial = 0.5f * (0.2f + std::abs(octave(1, kPoint)));
  EXPECT_NEAR(turbulence(kPoint, {std::exp2(-2.5f), 0, 0}, {}, params),
              std::abs(octave(0, kPoint)) + 0.5f * partial + 0.2f * (0.5f + 0.25f), 1e-5f);
}

TEST(FractalTextures, LookUpTheMappedPoint) {
  const Mapping3d twice(Transform::scale(2, 2, 2));
  const FractalParams params{.octaves = 3, .roughness = 0.6f};
  SurfaceInteraction si = atPoint(kPoint);
  si.dpdx = {0x1p-4f, 0, 0};
  const Point3f p = 2 * kPoint;
  const Vector3f dpdx{0x1p-3f, 0, 0};
  EXPECT_EQ(FbmTexture<float>(twice, params).evaluate(si), fbm(p, dpdx, {}, params));
  EXPECT_EQ(FbmTexture<Rgb>(twice, params).evaluate(si), Rgb(fbm(p, dpdx, {}, params)));
  EXPECT_EQ(WrinkledTexture<float>(twice, params).evaluate(si), turbulence(p, dpdx, {}, params));
  EXPECT_EQ(WrinkledTexture<Rgb>(twice, params).evaluate(si), Rgb(turbulence(p, dpdx, {}, params)));
}

TEST(WindyTexture, MultipliesStrengthAndHeight) {
  const float strength =
      octave(0, 0.1f * kPoint) + 0.5f * octave(1, 0.1f * kPoint) + 0.25f * octave(2, 0.1f * kPoint);
  const float height = fbm(kPoint, {}, {}, {.octaves = 6, .roughness = 0.5f});
  EXPECT_NEAR(WindyTexture<float>(Mapping3d{}).evaluate(atPoint(kPoint)), std::abs(strength) * height, 1e-5f);
  EXPECT_NE(height * strength, 0);
}

TEST(MarbleColor, IsABezierCurveThatRunsPastItsEnd) {
  const auto expectNear = [](Rgb a, Rgb b) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 2e-5f * std::max(1.0f, std::abs(b[c])));
  };
  expectNear(marbleColor(0), {0.87f, 0.87f, 0.9f});
  // t = 1/12: the middle of segment 0, weights 1/8 3/8 3/8 1/8 of c0..c3.
  expectNear(marbleColor(1.0f / 12), 1.5f * (0.875f * Rgb(0.58f, 0.58f, 0.6f) + 0.125f * Rgb(0.5f)));
  // t = 1: segment 1 at x = 5, weights (1-x)³ 3x(1-x)² 3x²(1-x) x³ = -64 240 -300 125 of c1..c4.
  expectNear(marbleColor(1), 1.5f * (176.0f * Rgb(0.58f, 0.58f, 0.6f) + -300.0f * Rgb(0.5f) +
                                     125.0f * Rgb(0.6f, 0.59f, 0.58f)));
}

TEST(MarbleTexture, DisturbsLayersAlongY) {
  const MarbleTexture still(Mapping3d{}, {.fractal = {}, .scale = 3, .variation = 0});
  EXPECT_EQ(still.evaluate(atPoint(kPoint)), marbleColor(0.5f + 0.5f * std::sin(3 * kPoint.y)));
  const MarbleTexture disturbed(
      Mapping3d{}, {.fractal = {.octaves = 5, .roughness = 0.4f}, .scale = 3, .variation = 0.7f});
  SurfaceInteraction si = atPoint(kPoint);
  si.dpdx = {0.01f, 0, 0};
  const float m = 3 * kPoint.y + 0.7f * fbm(3 * kPoint, {0.03f, 0, 0}, {}, {.octaves = 5, .roughness = 0.4f});
  const Rgb expected = marbleColor(0.5f + 0.5f * std::sin(m)), found = disturbed.evaluate(si);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-3f * (1 + std::abs(expected[c])));
}

}  // namespace
}  // namespace pbrtmedia
