// SPDX-License-Identifier: BSD-2-Clause
#include "lights/goniometric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "lights/light_test_support.h"

namespace pbrtmedia {
namespace {

using test::expectRgb;
using test::kMiddle;
using test::makePicture;

Image fourByFour() {
  // Red counts columns, green rows: a texel tells where it lies.
  return makePicture(4, 4, [](int x, int y) { return Rgb(1.0f + x, 1.0f + y, 1.0f); });
}

/// Centre of texel (x, y) of a 4 x 4 map as a direction: θ from +y, φ = atan2(z, x).
Vector3f direction(int x, int y) {
  const double theta = std::numbers::pi * (y + 0.5) / 4, phi = 2 * std::numbers::pi * (x + 0.5) / 4;
  return Vector3f(Vec3d{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)});
}

TEST(GoniometricLight, LooksUpTexelsWithThePoleOnPlusY) {
  const GoniometricLight light(Transform(), {.intensity = {2, 2, 2}, .map = fourByFour()});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      const LightSample s = light.sample(3 * direction(x, y), kMiddle);
      EXPECT_NEAR(s.distance, 3, 1e-6f);
      expectRgb(s.radiance, Rgb(1.0f + x, 1.0f + y, 1.0f) * (2.0f / 9));
    }
  }
}

TEST(GoniometricLight, TurnsFromPlusXTowardPlusZ) {
  // Between texel columns: φ = 90° (direction +z) lies between columns 0 and 1 of 4, 270° between 2 and 3.
  const GoniometricLight light(Transform(), {.map = fourByFour()});
  EXPECT_NEAR(light.sample({0, 0, 1}, kMiddle).radiance.r, 1.5f, 1e-5f);
  EXPECT_NEAR(light.sample({0, 0, -1}, kMiddle).radiance.r, 3.5f, 1e-5f);
  EXPECT_NEAR(light.sample({-1, 0, 0}, kMiddle).radiance.r, 2.5f, 1e-5f);
  EXPECT_NEAR(light.sample({1, 0, 0}, kMiddle).radiance.r, 2.5f, 1e-5f) << "columns 3 and 0 meet at +x";
  EXPECT_NEAR(light.sample({1, 0, 0}, kMiddle).radiance.g, 2.5f, 1e-5f) << "the equator";
}

TEST(GoniometricLight, ShowsTheTopRowTowardPlusY) {
  const GoniometricLight light(
      Transform(), {.map = makePicture(8, 8, [](int, int y) { return Rgb(y < 4 ? 1.0f : 0.0f); })});
  // 30 degrees from the pole, more than the half texel in which the rows at both poles blend.
  EXPECT_NEAR(light.sample({0.5f, std::sqrt(0.75f), 0}, kMiddle).radiance.r, 1, 1e-5f);
  EXPECT_NEAR(light.sample({0, std::sqrt(0.75f), -0.5f}, kMiddle).radiance.r, 1, 1e-5f);
  EXPECT_TRUE(light.sample({0.5f, -std::sqrt(0.75f), 0}, kMiddle).radiance.isBlack());
}

TEST(GoniometricLight, FollowsTheTransform) {
  const Transform place = Transform::translate({1, 2, 3}) * Transform::rotate(90, {1, 0, 0});  // +y to +z
  const GoniometricLight light(place, {.map = fourByFour()});
  EXPECT_EQ(light.position(), (Point3f{1, 2, 3}));
  const Vector3f w = place.vector(direction(2, 1));
  expectRgb(light.sample(light.position() + w, kMiddle).radiance, {3, 2, 1}, 1e-4f);
}

TEST(GoniometricLight, IsAPlainPointLightWithoutAMap) {
  const GoniometricLight light(Transform(), {.intensity = {1, 2, 3}});
  expectRgb(light.sample({0, 2, 0}, kMiddle).radiance, Rgb{1, 2, 3} * 0.25f);
  expectRgb(light.power(), 4 * kPi * Rgb{1, 2, 3});
  EXPECT_EQ(light.sample({0, 0, 0}, kMiddle).pdf, 0);
}

TEST(GoniometricLight, PowerTakesTheMeanOfTheMap) {
  const GoniometricLight light(Transform(), {.intensity = {2, 2, 2}, .map = fourByFour()});
  expectRgb(light.power(), 8 * kPi * Rgb{2.5f, 2.5f, 1});
}

TEST(GoniometricLight, NamesThePixelThatIsNoColour) {
  Image image = fourByFour();
  image.setRgb(2, 3, {1, std::numeric_limits<float>::quiet_NaN(), 1});
  try {
    GoniometricLight(Transform(), {.map = image});
    FAIL() << "accepted NaN";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("(2, 3)"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace pbrtmedia
