// SPDX-License-Identifier: BSD-2-Clause
#include "lights/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lights/light_test_support.h"

namespace pbrtmedia {
namespace {

using test::expectRgb;
using test::kMiddle;
using test::makePicture;

/// 2 x 2: top left red 1, top right 2, bottom left 3, bottom right 4.
Image twoByTwo() {
  return makePicture(2, 2, [](int x, int y) { return Rgb(static_cast<float>(1 + x + 2 * y)); });
}

/// Red at the screen point (x, y) of a light of fov 90, seen at z = 1; the 1/r² taken out.
float at(const Light& light, float x, float y) {
  const LightSample s = light.sample({x, y, 1}, kMiddle);
  return s.radiance.r * (1 + x * x + y * y);
}

TEST(ProjectionLight, PutsTheTopRowTowardMinusYAndTheLeftColumnTowardMinusX) {
  const ProjectionLight light(Transform(), {.fov = 90, .map = twoByTwo()});
  EXPECT_NEAR(at(light, -0.5f, -0.5f), 1, 1e-5f);
  EXPECT_NEAR(at(light, 0.5f, -0.5f), 2, 1e-5f);
  EXPECT_NEAR(at(light, -0.5f, 0.5f), 3, 1e-5f);
  EXPECT_NEAR(at(light, 0.5f, 0.5f), 4, 1e-5f);
  EXPECT_NEAR(at(light, 0, 0), 2.5f, 1e-5f);
}

TEST(ProjectionLight, IsBlackOutsideTheWindowAndBehind) {
  const ProjectionLight light(Transform(), {.fov = 90, .map = twoByTwo()});
  EXPECT_GT(at(light, 0.999f, 0.999f), 0);
  EXPECT_EQ(at(light, 1.001f, 0), 0);
  EXPECT_EQ(at(light, 0, -1.001f), 0);
  for (const Point3f p : {Point3f{0, 0, -1}, Point3f{1, 0, 0}, Point3f{0.5f, 0.5f, -1}}) {
    EXPECT_TRUE(light.sample(p, kMiddle).radiance.isBlack()) << p;
  }
}

TEST(ProjectionLight, SpansTheFovOnTheShorterAxisOfThePicture) {
  const auto white = [](int, int) { return Rgb(1); };
  const ProjectionLight wide(Transform(), {.fov = 90, .map = makePicture(6, 3, white)});
  EXPECT_GT(at(wide, 1.99f, 0.99f), 0);
  EXPECT_EQ(at(wide, 2.01f, 0), 0);
  EXPECT_EQ(at(wide, 0, 1.01f), 0);
  const ProjectionLight tall(Transform(), {.fov = 90, .map = makePicture(3, 6, white)});
  EXPECT_GT(at(tall, 0.99f, 1.99f), 0);
  EXPECT_EQ(at(tall, 1.01f, 0), 0);
  EXPECT_EQ(at(tall, 0, 2.01f), 0);
  const ProjectionLight narrow(Transform(), {.fov = 20, .map = makePicture(3, 3, white)});
  const auto edge = static_cast<float>(std::tan(radians(10.0)));
  EXPECT_GT(at(narrow, 0.999f * edge, 0), 0);
  EXPECT_EQ(at(narrow, 1.001f * edge, 0), 0);
}

TEST(ProjectionLight, FollowsTheTransformAndTheInverseSquare) {
  const Transform place = Transform::translate({5, 0, 0}) * Transform::rotate(90, {0, 1, 0});  // +z to +x
  const ProjectionLight light(place, {.intensity = {8, 4, 2}, .fov = 90});
  const LightSample s = light.sample({7, 0, 0}, kMiddle);
  EXPECT_EQ(s.distance, 2);
  expectRgb(s.radiance, {2, 1, 0.5f});
  EXPECT_TRUE(light.sample({3, 0, 0}, kMiddle).radiance.isBlack());
  EXPECT_EQ(light.sample({5, 0, 0}, kMiddle).pdf, 0);
}

TEST(ProjectionLight, PowerBoundsTheWindowByItsCorner) {
  // fov 90 and a square window: the corner direction is (1, 1, 1), cosine 1/√3.
  const ProjectionLight light(Transform(), {.intensity = {1, 2, 3}, .fov = 90, .map = twoByTwo()});
  expectRgb(light.power(), static_cast<float>(2 * kPi * (1 - 1 / std::sqrt(3.0)) * 2.5) * Rgb{1, 2, 3});
}

TEST(ProjectionLight, PowerKnowsThatAPictureIsWiderThanHigh) {
  // fov 90 over the height: the corner direction is (2, 1, 1), cosine 1/√6.
  Image wide(4, 2);
  for (float& v : wide.data()) v = 1;
  const ProjectionLight light(Transform(), {.intensity = {1, 2, 3}, .fov = 90, .map = wide});
  expectRgb(light.power(), static_cast<float>(2 * kPi * (1 - 1 / std::sqrt(6.0))) * Rgb{1, 2, 3});
}

TEST(ProjectionLight, RefusesBadFovTransformAndMap) {
  EXPECT_THROW(ProjectionLight(Transform(), {.fov = 0}), std::invalid_argument);
  EXPECT_THROW(ProjectionLight(Transform(), {.fov = 180}), std::invalid_argument);
  EXPECT_THROW(ProjectionLight(Transform::scale(1, 0, 1), {}), std::invalid_argument);
  EXPECT_THROW(ProjectionLight(Transform(), {.map = Image()}), std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
