// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/diagnostics.h"
#include "filters/box.h"
#include "filters/gaussian.h"
#include "filters/mitchell.h"
#include "filters/sinc.h"
#include "filters/triangle.h"

namespace pbrtmedia {
namespace {

TEST(FilterDefaults, AreThoseOfPbrt) {
  EXPECT_EQ(BoxFilter({}).radius(), (Vector2f{0.5f, 0.5f}));
  EXPECT_EQ(TriangleFilter({}).radius(), (Vector2f{2, 2}));
  EXPECT_EQ(GaussianFilter({}).radius(), (Vector2f{2, 2}));
  EXPECT_EQ(GaussianFilter::Params{}.alpha, 2.0f);
  EXPECT_EQ(MitchellFilter({}).radius(), (Vector2f{2, 2}));
  EXPECT_EQ(MitchellFilter::Params{}.b, 1.0f / 3);
  EXPECT_EQ(MitchellFilter::Params{}.c, 1.0f / 3);
  EXPECT_EQ(SincFilter({}).radius(), (Vector2f{4, 4}));
  EXPECT_EQ(SincFilter::Params{}.tau, 3.0f);
}

TEST(BoxFilter, IsOneEverywhere) {
  const BoxFilter f({.radius = {1, 3}});
  EXPECT_EQ(f.evaluate({0, 0}), 1.0f);
  EXPECT_EQ(f.evaluate({-1, 3}), 1.0f);
}

TEST(TriangleFilter, FallsLinearlyToTheRadius) {
  const TriangleFilter f({.radius = {2, 4}});
  EXPECT_EQ(f.evaluate({0, 0}), 8.0f);
  EXPECT_EQ(f.evaluate({0.5f, -1}), 4.5f);
  EXPECT_EQ(f.evaluate({2, 0}), 0.0f);
  EXPECT_EQ(f.evaluate({3, 5}), 0.0f);  // not (-1)(-1)
}

TEST(GaussianFilter, IsShiftedToZeroAtTheRadius) {
  const GaussianFilter f({.radius = {2, 1}, .alpha = 0.5f});
  // g(0) = 1 - e^-2 in x, 1 - e^-0.5 in y; g(1) = e^-0.5 - e^-2.
  EXPECT_FLOAT_EQ(f.evaluate({0, 0}), static_cast<float>((1 - std::exp(-2.0)) * (1 - std::exp(-0.5))));
  EXPECT_FLOAT_EQ(f.evaluate({-1, 0}),
                  static_cast<float>((std::exp(-0.5) - std::exp(-2.0)) * (1 - std::exp(-0.5))));
  EXPECT_EQ(f.evaluate({2, 0}), 0.0f);
  EXPECT_EQ(f.evaluate({3, 3}), 0.0f);
}

TEST(MitchellFilter, HasTheValuesOfThePaperAtTheKnots) {
  // B = C = 1/3: m(0) = 8/9, m(1) = 1/18, m(2) = 0; m(3/2) = -5/144 by hand.
  const MitchellFilter f({});
  EXPECT_FLOAT_EQ(f.evaluate({0, 0}), 64.0f / 81);
  EXPECT_FLOAT_EQ(f.evaluate({1, 0}), 8.0f / 9 / 18);
  EXPECT_FLOAT_EQ(f.evaluate({-1, 1}), 1.0f / 324);
  EXPECT_NEAR(f.evaluate({1.5f, 0}), -5.0 / 144 * 8 / 9, 1e-7);
  EXPECT_EQ(f.evaluate({2, 0}), 0.0f);
}

TEST(MitchellFilter, BSplineAndCatmullRomAreItsCorners) {
  const MitchellFilter spline({.b = 1, .c = 0}), catmullRom({.b = 0, .c = 0.5f});
  EXPECT_FLOAT_EQ(spline.evaluate({0, 0}), 4.0f / 9);  // (2/3)^2
  EXPECT_FLOAT_EQ(spline.evaluate({1, 0}), 1.0f / 9);  // (1/6)(2/3)
  EXPECT_FLOAT_EQ(catmullRom.evaluate({0, 0}), 1.0f);
  EXPECT_NEAR(catmullRom.evaluate({1, 0}), 0, 1e-7);  // it interpolates
}

TEST(MitchellFilter, IsAPartitionOfUnityAtItsOwnScale) {
  // Copies one unit of t apart, that is radius / 2, sum to 1 for every offset and any B and C.
  const MitchellFilter f({.radius = {2, 2}, .b = 0.2f, .c = 0.7f});
  const double centre = std::sqrt(static_cast<double>(f.evaluate({0, 0})));
  for (const float x : {0.0f, 0.1f, 0.5f, 0.93f}) {
    double sum = 0;
    for (int k = -2; k <= 2; ++k) sum += f.evaluate({x + static_cast<float>(k), 0}) / centre;
    EXPECT_NEAR(sum, 1, 1e-6) << x;
  }
}

TEST(SincFilter, IsWindowedAndVanishesAtWholePixels) {
  const SincFilter f({});
  EXPECT_EQ(f.evaluate({0, 0}), 1.0f);
  for (int k = 1; k <= 4; ++k) EXPECT_NEAR(f.evaluate({static_cast<float>(k), 0}), 0, 1e-7);
  // sinc(1/2) = 2/pi and sinc(1/6) = 3/pi.
  EXPECT_NEAR(f.evaluate({0.5f, 0}), 6 / (M_PI * M_PI), 1e-7);
  EXPECT_NEAR(f.evaluate({-0.5f, 0.5f}), 36 / std::pow(M_PI, 4), 1e-7);
  EXPECT_LT(f.evaluate({1.5f, 0}), 0.0f);
  EXPECT_EQ(f.evaluate({4.01f, 0}), 0.0f);
  EXPECT_EQ(f.evaluate({1e-8f, 0}), 1.0f);
}

TEST(FilterParameters, OutOfRangeAreErrorsThatNameThem) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  EXPECT_THROW(BoxFilter({.radius = {0, 1}}), SceneError);
  EXPECT_THROW(TriangleFilter({.radius = {1, -1}}), SceneError);
  EXPECT_THROW(SincFilter({.radius = {inf, 1}}), SceneError);
  EXPECT_THROW(MitchellFilter({.radius = {nan, 1}}), SceneError);
  EXPECT_THROW(GaussianFilter({.alpha = 0}), SceneError);
  EXPECT_THROW(GaussianFilter({.alpha = inf}), SceneError);
  EXPECT_THROW(MitchellFilter({.b = nan}), SceneError);
  EXPECT_THROW(MitchellFilter({.c = inf}), SceneError);
  EXPECT_THROW(SincFilter({.tau = -3}), SceneError);
  try {
    GaussianFilter({.radius = {2, -1}});
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_STREQ(e.what(), "pixel filter \"gaussian\": ywidth is -1; expected a radius in (0, 1000] pixels");
  }
}

}  // namespace
}  // namespace pbrtmedia
