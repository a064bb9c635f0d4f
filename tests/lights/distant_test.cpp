// SPDX-License-Identifier: BSD-2-Clause
#include "lights/distant.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "lights/light_test_support.h"

namespace pbrtmedia {
namespace {

using test::expectRgb;
using test::kMiddle;

TEST(DistantLight, ShinesTowardPlusZByDefault) {
  const DistantLight light(Transform(), {});
  const LightSample s = light.sample({7, -3, 1e6f}, kMiddle);
  EXPECT_EQ(s.wi, (Vector3f{0, 0, -1}));
  EXPECT_EQ(s.distance, kInfinity);
  EXPECT_EQ(s.pdf, 1);
  // Matte Kd 0.5, perpendicular: 0.5/π = 0.15915.
  EXPECT_NEAR(0.5f * kInvPi * s.radiance.r, 0.15915f, 5e-6f);
}

TEST(DistantLight, TravelsFromFromTowardToThroughTheTransform) {
  const Transform place = Transform::translate({100, 0, 0}) * Transform::rotate(90, {0, 0, 1}) *
                          Transform::scale(3, 3, 3);  // +x to +y
  const DistantLight light(place, {.radiance = {1, 2, 3}, .from = {5, 5, 5}, .to = {7, 5, 5}});
  EXPECT_NEAR(length(light.toLight() - Vector3f{0, -1, 0}), 0, 1e-7f);
  expectRgb(light.sample({0, 0, 0}, kMiddle).radiance, {1, 2, 3});
}

TEST(DistantLight, PowerIsWhatCrossesTheBoundingSphereOfTheScene) {
  DistantLight light(Transform(), {.radiance = {1, 2, 3}});
  light.preprocess({{-1, -2, -2}, {1, 2, 2}});  // diagonal 6, radius 3
  expectRgb(light.power(), 9 * kPi * Rgb{1, 2, 3});
  light.preprocess({});
  EXPECT_TRUE(light.power().isBlack()) << "an empty scene catches nothing";
}

TEST(DistantLight, IsNeitherHitNorSeen) {
  const DistantLight light(Transform(), {});
  EXPECT_TRUE(light.isDelta());
  EXPECT_FALSE(light.isInfinite());
  EXPECT_EQ(light.pdf({}, {0, 0, -1}, nullptr), 0);
  EXPECT_TRUE(light.background({0, 0, -1}).isBlack());
}

TEST(DistantLight, RefusesADirectionOfNoLength) {
  EXPECT_THROW(DistantLight(Transform(), {.from = {1, 0, 0}, .to = {1, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(DistantLight(Transform::scale(1, 1, 0), {}), std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
