// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/environment.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "cameras/camera_test_support.h"

namespace pbrtmedia {
namespace {

using test::expectNear;
using test::kFloatRounding;

const EnvironmentCamera::Params kFilm{.fullResolution = {400, 200}};

Vector3f directionAt(const Camera& camera, float x, float y) {
  return camera.generateRay({x, y}, {0.5f, 0.5f}, 0).ray.d;
}

TEST(EnvironmentCamera, HasPlusYAtTheTopAndMinusYAtTheBottom) {
  const EnvironmentCamera camera(AnimatedTransform(Transform()), kFilm);
  for (const float x : {0.0f, 123.0f, 399.0f}) {
    expectNear(directionAt(camera, x, 0), {0, 1, 0}, kFloatRounding);
    expectNear(directionAt(camera, x, 200), {0, -1, 0}, kFloatRounding);
  }
}

TEST(EnvironmentCamera, TurnsFromPlusXTowardPlusZAlongTheHorizon) {
  const EnvironmentCamera camera(AnimatedTransform(Transform()), kFilm);
  expectNear(directionAt(camera, 0, 100), {1, 0, 0}, kFloatRounding);
  expectNear(directionAt(camera, 100, 100), {0, 0, 1}, kFloatRounding);
  expectNear(directionAt(camera, 200, 100), {-1, 0, 0}, kFloatRounding);
  expectNear(directionAt(camera, 300, 100), {0, 0, -1}, kFloatRounding);
  expectNear(directionAt(camera, 50, 50), {0.5, std::sqrt(0.5), 0.5}, kFloatRounding);
}

TEST(EnvironmentCamera, IsPlacedAndTurnedByTheCameraTransform) {
  const Transform place = Transform::translate({1, 2, 3}) * Transform::rotate(90, {0, 0, 1});
  const EnvironmentCamera camera(AnimatedTransform(place), kFilm);
  EXPECT_EQ(camera.generateRay({7, 8}, {}, 0).ray.o, (Point3f{1, 2, 3}));
  expectNear(directionAt(camera, 0, 0), {-1, 0, 0}, kFloatRounding);
  expectNear(directionAt(camera, 0, 100), {0, 1, 0}, kFloatRounding);
}

TEST(EnvironmentCamera, MovesWithItsTransformAtTheTimeOfTheRay) {
  const AnimatedTransform moving(Transform(), 0, Transform::translate({0, 6, 0}), 1);
  const EnvironmentCamera camera(moving,
                                 {.fullResolution = {400, 200}, .shutterOpen = 0.5f, .shutterClose = 1});
  const RayDifferential ray = camera.generateRay({7, 8}, {}, 0).ray;
  EXPECT_EQ(ray.time, 0.5f);
  expectNear(ray.o, {0, 3, 0}, 1e-6);
}

TEST(EnvironmentCamera, DifferentialsAreTheNeighbouringRays) {
  const Transform place = Transform::translate({1, -2, 3}) * Transform::rotate(50, {1, 1, 0});
  test::expectTrueDifferentials(EnvironmentCamera(AnimatedTransform(place), kFilm), {400, 200});
}

TEST(EnvironmentCamera, RefusesEmptyFilms) {
  EXPECT_THROW(EnvironmentCamera(AnimatedTransform(Transform()), {.fullResolution = {0, 5}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
