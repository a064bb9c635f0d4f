// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/orthographic.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "cameras/camera_test_support.h"

namespace pbrtmedia {
namespace {

using test::expectNear;
using test::kFloatRounding;

OrthographicCamera::Params film(int width, int height) {
  return {.fullResolution = {width, height}, .screenWindow = resolveScreenWindow({width, height}, {}, {})};
}

Ray rayAt(const Camera& camera, float x, float y, Point2f lens = {0.5f, 0.5f}) {
  return camera.generateRay({x, y}, lens, 0).ray;
}

TEST(OrthographicCamera, StartsOnTheScreenWindowAndLooksAlongPlusZ) {
  OrthographicCamera::Params params = film(200, 100);
  params.screenWindow = {-30, 10, -5, 15};
  const OrthographicCamera camera(AnimatedTransform(Transform()), params);
  expectNear(rayAt(camera, 0, 0).o, {-30, 15, 0}, 1e-5);
  expectNear(rayAt(camera, 200, 100).o, {10, -5, 0}, 1e-5);
  expectNear(rayAt(camera, 150, 25).o, {0, 10, 0}, 1e-5);
  for (const float x : {0.0f, 77.0f, 200.0f}) EXPECT_EQ(rayAt(camera, x, 3).d, (Vector3f{0, 0, 1}));
}

TEST(OrthographicCamera, ShowsOneUnitToEachSideOfTheShorterAxis) {
  const OrthographicCamera camera(AnimatedTransform(Transform()), film(300, 100));
  expectNear(rayAt(camera, 0, 0).o, {-3, 1, 0}, 1e-6);
  expectNear(rayAt(camera, 300, 100).o, {3, -1, 0}, 1e-6);
}

TEST(OrthographicCamera, LensOffsetsStartFromTheScreenPointAndRaysMeetInTheFocalPlane) {
  OrthographicCamera::Params params = film(200, 100);
  params.lensRadius = 0.25f;
  params.focalDistance = 3;
  const OrthographicCamera camera(AnimatedTransform(Transform()), params);
  const Vec3d screen{2 * (150.0 / 100 - 1), 1 - 10.0 / 50, 0};
  Rng rng(11);
  double farthest = 0;
  for (int i = 0; i < 500; ++i) {
    const Ray r = rayAt(camera, 150, 10, {rng.uniform(), rng.uniform()});
    const double radius = length(Vec3d(r.o) - screen);
    EXPECT_LE(radius, 0.25 + kFloatRounding);
    farthest = std::max(farthest, radius);
    expectNear(r.at(3 / r.d.z), screen + Vec3d{0, 0, 3}, 2e-6);
  }
  EXPECT_GT(farthest, 0.245) << "the lens is not covered";
}

TEST(OrthographicCamera, ScalesAndPlacesByTheCameraTransform) {
  const Transform place = Transform::translate({1, 2, 3}) * Transform::scale(-5, 5, 5);
  const OrthographicCamera camera(AnimatedTransform(place), film(100, 100));
  expectNear(rayAt(camera, 0, 0).o, {6, 7, 3}, 1e-5);  // mirrored: the left edge lies toward +x
  expectNear(rayAt(camera, 0, 0).d, {0, 0, 1}, kFloatRounding);
}

TEST(OrthographicCamera, DifferentialsAreTheNeighbouringRays) {
  OrthographicCamera::Params params = film(320, 200);
  const Transform place = Transform::translate({1, -2, 3}) * Transform::rotate(50, {1, 1, 0});
  test::expectTrueDifferentials(OrthographicCamera(AnimatedTransform(place), params), {320, 200});
  params.lensRadius = 0.3f;
  params.focalDistance = 2;
  const AnimatedTransform moving(place, 0, place * Transform::rotate(20, {0, 1, 0}), 1);
  test::expectTrueDifferentials(OrthographicCamera(moving, params), {320, 200});
}

TEST(OrthographicCamera, RefusesParametersOutOfRange) {
  OrthographicCamera::Params params = film(10, 10);
  params.lensRadius = 1;
  params.focalDistance = -1;
  EXPECT_THROW(OrthographicCamera(AnimatedTransform(Transform()), params), std::invalid_argument);
  params = film(10, 10);
  params.screenWindow.xMax = params.screenWindow.xMin;
  EXPECT_THROW(OrthographicCamera(AnimatedTransform(Transform()), params), std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
