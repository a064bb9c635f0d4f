// SPDX-License-Identifier: BSD-2-Clause
#include "lights/point.h"

#include <gtest/gtest.h>

#include "lights/light_test_support.h"

namespace pbrtmedia {
namespace {

using test::expectRgb;
using test::kMiddle;

TEST(PointLight, LightsAMattePlaneAsTheReferenceTableSays) {
  // Kd 0.5, I 1, distance 2, normal incidence: 0.5/π · 1/4 = 0.03979.
  const PointLight light(Transform::translate({0, 0, 2}), {});
  const LightSample s = light.sample({0, 0, 0}, kMiddle);
  EXPECT_EQ(s.wi, (Vector3f{0, 0, 1}));
  EXPECT_EQ(s.distance, 2);
  EXPECT_EQ(s.pdf, 1);
  EXPECT_NEAR(0.5f * kInvPi * s.radiance.g * s.wi.z, 0.03979f, 5e-6f);
}

TEST(PointLight, FallsOffWithTheSquareOfTheDistance) {
  const PointLight light(Transform(), {.intensity = {4, 8, 16}});
  expectRgb(light.sample({0, 0, -4}, kMiddle).radiance, {0.25f, 0.5f, 1});
  expectRgb(light.sample({6, 8, 0}, kMiddle).radiance, {0.04f, 0.08f, 0.16f});
}

TEST(PointLight, AddsFromInWorldSpaceWithoutTurningOrScalingIt) {
  const Transform place =
      Transform::translate({10, 20, 30}) * Transform::rotate(90, {0, 0, 1}) * Transform::scale(5, 5, 5);
  const PointLight light(place, {.from = {1, 2, 3}});
  EXPECT_EQ(light.position(), (Point3f{11, 22, 33}));
}

TEST(PointLight, HasNoSampleAtItsOwnPosition) {
  const PointLight light(Transform(), {.from = {1, 2, 3}});
  EXPECT_EQ(light.sample({1, 2, 3}, kMiddle).pdf, 0);
}

TEST(PointLight, StaysFiniteAtHugeAndTinyDistances) {
  const PointLight light(Transform(), {});
  const LightSample far = light.sample({1e25f, 0, 0}, kMiddle);
  EXPECT_EQ(far.wi, (Vector3f{-1, 0, 0}));
  EXPECT_EQ(far.distance, 1e25f);
  EXPECT_TRUE(far.radiance.isFinite());
  const LightSample near = light.sample({0, 1e-15f, 0}, kMiddle);
  EXPECT_EQ(near.wi, (Vector3f{0, -1, 0}));
  EXPECT_NEAR(near.radiance.r, 1e30f, 1e25f);
}

TEST(PointLight, EmitsFourPiTimesItsIntensity) {
  expectRgb(PointLight(Transform(), {.intensity = {1, 2, 3}}).power(), 4 * kPi * Rgb{1, 2, 3});
}

TEST(PointLight, CannotBeHit) {
  const PointLight light(Transform(), {});
  EXPECT_TRUE(light.isDelta());
  EXPECT_FALSE(light.isInfinite());
  EXPECT_EQ(light.pdf({0, 0, 1}, {0, 0, -1}, nullptr), 0);
}

}  // namespace
}  // namespace pbrtmedia
