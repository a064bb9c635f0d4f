// SPDX-License-Identifier: BSD-2-Clause
#include "lights/spot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lights/light_test_support.h"

namespace pbrtmedia {
namespace {

using test::expectRgb;
using test::kMiddle;

/// The point at distance 1 from the origin under `degreesFromAxis` from +z.
Point3f under(double degreesFromAxis) {
  const double a = radians(degreesFromAxis);
  return {static_cast<float>(std::sin(a)), 0, static_cast<float>(std::cos(a))};
}

TEST(SpotLight, IsASixteenthInTheMiddleOfTheFalloff) {
  const SpotLight light(Transform(), {.coneAngle = 40, .coneDeltaAngle = 15});
  const double middle = (std::cos(radians(40.0)) + std::cos(radians(25.0))) / 2;
  EXPECT_NEAR(light.falloff(middle), 0.0625, 1e-12);
  EXPECT_NEAR(light.sample(under(degrees(std::acos(middle))), kMiddle).radiance.r, 0.0625f, 1e-6f);
}

TEST(SpotLight, IsFullInsideTheRingAndBlackOutsideTheCone) {
  const SpotLight light(Transform(), {.intensity = {1, 2, 3}, .coneAngle = 30, .coneDeltaAngle = 5});
  for (const double a : {0.0, 12.0, 24.99}) expectRgb(light.sample(under(a), kMiddle).radiance, {1, 2, 3});
  for (const double a : {30.01, 60.0, 90.0, 180.0}) {
    EXPECT_TRUE(light.sample(under(a), kMiddle).radiance.isBlack()) << a << " degrees";
  }
  const float r25 = light.sample(under(25.5), kMiddle).radiance.r;
  const float r29 = light.sample(under(29.0), kMiddle).radiance.r;
  EXPECT_LT(r25, 1);
  EXPECT_LT(r29, r25);
  EXPECT_GT(r29, 0);
}

TEST(SpotLight, HasASharpEdgeWithoutARing) {
  const SpotLight light(Transform(), {.coneAngle = 20, .coneDeltaAngle = 0});
  EXPECT_EQ(light.sample(under(19.999), kMiddle).radiance.r, 1);
  EXPECT_EQ(light.sample(under(20.001), kMiddle).radiance.r, 0);
}

TEST(SpotLight, ResolvesConesFarThinnerThanAFloatCosine) {
  // cos(0.01°) = 1 - 1.5e-8 rounds to 1 in single precision.
  const SpotLight light(Transform(), {.coneAngle = 0.01f, .coneDeltaAngle = 0});
  EXPECT_EQ(light.sample({0, 0.9e-4f, 1}, kMiddle).radiance.isBlack(), false);  // 0.0052 degrees
  EXPECT_EQ(light.sample({0, 1.9e-4f, 1}, kMiddle).radiance.isBlack(), true);   // 0.0109 degrees
}

TEST(SpotLight, TransformsFromAndTo) {
  const Transform place = Transform::translate({0, 0, 10}) * Transform::rotate(90, {0, 1, 0});  // +z to +x
  const SpotLight light(place, {.from = {0, 0, 1}, .to = {0, 0, 5}});
  EXPECT_EQ(light.position(), (Point3f{1, 0, 10}));
  const LightSample s = light.sample({4, 0, 10}, kMiddle);
  EXPECT_EQ(s.wi, (Vector3f{-1, 0, 0}));
  EXPECT_EQ(s.distance, 3);
  expectRgb(s.radiance, Rgb(1.0f / 9));
  EXPECT_TRUE(light.sample({-4, 0, 10}, kMiddle).radiance.isBlack());
}

TEST(SpotLight, MeasuresItsConeInLightSpace) {
  // A light space stretched twofold in x widens the cone there: tan = 2 tan(30°) is its edge.
  const SpotLight light(Transform::scale(2, 1, 1), {.coneAngle = 30, .coneDeltaAngle = 0});
  const auto edge = static_cast<float>(2 * std::tan(radians(30.0)));
  EXPECT_FALSE(light.sample({0.999f * edge, 0, 1}, kMiddle).radiance.isBlack());
  EXPECT_TRUE(light.sample({1.001f * edge, 0, 1}, kMiddle).radiance.isBlack());
}

TEST(SpotLight, PowerCountsTheRingHalf) {
  const SpotLight light(Transform(), {.intensity = {1, 2, 3}, .coneAngle = 60, .coneDeltaAngle = 15});
  const double share = 1 - 0.5 * (std::cos(radians(60.0)) + std::cos(radians(45.0)));
  expectRgb(light.power(), static_cast<float>(2 * std::numbers::pi * share) * Rgb{1, 2, 3});
}

TEST(SpotLight, RefusesAnAxisWithoutDirectionAndASingularTransform) {
  EXPECT_THROW(SpotLight(Transform(), {.from = {1, 2, 3}, .to = {1, 2, 3}}), std::invalid_argument);
  EXPECT_THROW(SpotLight(Transform::scale(1, 1, 0), {}), std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
