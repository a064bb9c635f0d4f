// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/perspective.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "cameras/camera_test_support.h"

namespace pbrtmedia {
namespace {

using test::expectNear;
using test::kFloatRounding;

const AnimatedTransform kAtOrigin{Transform()};

PerspectiveCamera::Params film(int width, int height, float fov) {
  return {.fullResolution = {width, height},
          .screenWindow = resolveScreenWindow({width, height}, {}, {}),
          .fov = fov};
}

Ray rayAt(const Camera& camera, float x, float y, Point2f lens = {0.5f, 0.5f}, float time = 0) {
  return camera.generateRay({x, y}, lens, time).ray;
}

TEST(PerspectiveCamera, LooksAlongPlusZThroughTheCentre) {
  const PerspectiveCamera camera(kAtOrigin, film(200, 100, 90));
  const Camera::WeightedRay r = camera.generateRay({100, 50}, {0.5f, 0.5f}, 0);
  EXPECT_EQ(r.ray.o, (Point3f{0, 0, 0}));
  expectNear(r.ray.d, {0, 0, 1}, kFloatRounding);
  EXPECT_EQ(r.weight, 1);
  EXPECT_EQ(r.ray.tMax, kInfinity);
}

TEST(PerspectiveCamera, SpansTheFovOverTheHeightOfALandscapeFilm) {
  // fov 90: tan = 1, so the corners of a 2:1 film lie along (±2, ±1, 1) / √6, raster y down.
  const PerspectiveCamera camera(kAtOrigin, film(200, 100, 90));
  const double k = 1 / std::sqrt(6.0);
  expectNear(rayAt(camera, 0, 0).d, {-2 * k, k, k}, kFloatRounding);
  expectNear(rayAt(camera, 200, 0).d, {2 * k, k, k}, kFloatRounding);
  expectNear(rayAt(camera, 0, 100).d, {-2 * k, -k, k}, kFloatRounding);
  expectNear(rayAt(camera, 200, 100).d, {2 * k, -k, k}, kFloatRounding);
}

TEST(PerspectiveCamera, SpansTheFovOverTheWidthOfAPortraitFilm) {
  const PerspectiveCamera camera(kAtOrigin, film(100, 300, 60));
  const double t = std::tan(std::numbers::pi / 6);
  expectNear(rayAt(camera, 100, 150).d, normalize(Vec3d{t, 0, 1}), kFloatRounding);
  expectNear(rayAt(camera, 50, 0).d, normalize(Vec3d{0, 3 * t, 1}), kFloatRounding);
}

TEST(PerspectiveCamera, ScreenWindowChoosesWhatIsSeenWithoutChangingTheFov) {
  PerspectiveCamera::Params params = film(100, 100, 90);
  params.screenWindow = {0, 1, -1, 0};
  const PerspectiveCamera camera(kAtOrigin, params);
  expectNear(rayAt(camera, 0, 0).d, {0, 0, 1}, kFloatRounding);
  expectNear(rayAt(camera, 100, 0).d, normalize(Vec3d{1, 0, 1}), kFloatRounding);
  expectNear(rayAt(camera, 0, 100).d, normalize(Vec3d{0, -1, 1}), kFloatRounding);
}

TEST(PerspectiveCamera, KeepsNeighbouringPixelsOfATelescopeApart) {
  // 0.1 degree over 1000 pixels: one pixel is 1.7e-6 radians. Float directions resolve 6e-8, so a step must
  // be right to a tenth.
  const PerspectiveCamera camera(kAtOrigin, film(1000, 1000, 0.1f));
  const double step = 2 * std::tan(radians(0.1) / 2) / 1000;
  for (int x = 100; x < 900; x += 7) {
    const Ray a = rayAt(camera, static_cast<float>(x), 500),
              b = rayAt(camera, static_cast<float>(x) + 1, 500);
    EXPECT_NEAR(double{b.d.x} - a.d.x, step, 0.1 * step) << "pixel " << x;
  }
}

TEST(PerspectiveCamera, RaysOfOneFilmPointMeetInTheFocalPlane) {
  PerspectiveCamera::Params params = film(200, 100, 70);
  params.lensRadius = 0.5f;
  params.focalDistance = 4;
  const PerspectiveCamera camera(kAtOrigin, params);
  const double t = std::tan(radians(70.0) / 2);
  const Vec3d focus{4 * 2 * t * (30.0 / 100 - 1), 4 * t * (1 - 80.0 / 50), 4};  // raster (30, 80)
  Rng rng(3);
  double farthest = 0;
  for (int i = 0; i < 500; ++i) {
    const Ray r = rayAt(camera, 30, 80, {rng.uniform(), rng.uniform()});
    EXPECT_EQ(r.o.z, 0);
    const double radius = std::hypot(r.o.x, r.o.y);
    EXPECT_LE(radius, 0.5 + kFloatRounding);
    farthest = std::max(farthest, radius);
    expectNear(r.at((4 - r.o.z) / r.d.z), focus, 3e-6);
  }
  EXPECT_GT(farthest, 0.49) << "the lens is not covered";
}

TEST(PerspectiveCamera, MeetsTheFocalPlaneByZAndNotByDistance) {
  // Away from the plane the rays must differ, else the test above would pass with no lens at all.
  PerspectiveCamera::Params params = film(100, 100, 90);
  params.lensRadius = 1;
  params.focalDistance = 2;
  const PerspectiveCamera camera(kAtOrigin, params);
  const Ray a = rayAt(camera, 0, 50, {0.99f, 0.5f}), b = rayAt(camera, 0, 50, {0.01f, 0.5f});
  EXPECT_GT(distance(a.at(4 / a.d.z), b.at(4 / b.d.z)), 1.9f);
}

TEST(PerspectiveCamera, PlacesRaysByTheCameraTransformAndNormalises) {
  const Transform worldFromCamera =
      Transform::lookAt({1, 2, 3}, {1, 2, -7}, {0, 1, 0})->inverse();  // looks along -z, so right is -x
  const PerspectiveCamera camera(AnimatedTransform(worldFromCamera), film(100, 100, 90));
  EXPECT_EQ(rayAt(camera, 50, 50).o, (Point3f{1, 2, 3}));
  expectNear(rayAt(camera, 50, 50).d, {0, 0, -1}, kFloatRounding);
  expectNear(rayAt(camera, 100, 50).d, normalize(Vec3d{-1, 0, -1}), kFloatRounding);

  const PerspectiveCamera doubled(AnimatedTransform(worldFromCamera * Transform::scale(2, 2, 2)),
                                  film(100, 100, 90));
  expectNear(rayAt(doubled, 100, 0).d, Vec3d(rayAt(camera, 100, 0).d), kFloatRounding);
}

TEST(PerspectiveCamera, MirroredCamerasSwapLeftAndRight) {
  // `Scale -1 1 1` before LookAt: the world-to-camera map is scale * lookAt.
  const Transform look = *Transform::lookAt({0, 0, -5}, {0, 0, 0}, {0, 1, 0});
  const PerspectiveCamera plain(AnimatedTransform(look.inverse()), film(160, 90, 50));
  const PerspectiveCamera mirrored(AnimatedTransform((Transform::scale(-1, 1, 1) * look).inverse()),
                                   film(160, 90, 50));
  for (const float x : {0.0f, 10.0f, 33.25f, 80.0f}) {
    const Ray a = rayAt(plain, x, 20), b = rayAt(mirrored, 160 - x, 20);
    expectNear(b.d, Vec3d(a.d), kFloatRounding);
  }
  EXPECT_LT(rayAt(plain, 0, 20).d.x, 0);
  EXPECT_GT(rayAt(mirrored, 0, 20).d.x, 0);
}

TEST(PerspectiveCamera, DifferentialsAreTheNeighbouringRays) {
  PerspectiveCamera::Params params = film(320, 200, 65);
  const Transform place = Transform::translate({1, -2, 3}) * Transform::rotate(50, {1, 1, 0});
  test::expectTrueDifferentials(PerspectiveCamera(AnimatedTransform(place), params), {320, 200});
  params.lensRadius = 0.3f;
  params.focalDistance = 2;
  test::expectTrueDifferentials(PerspectiveCamera(AnimatedTransform(place), params), {320, 200});
  const AnimatedTransform moving(place, 0, place * Transform::rotate(20, {0, 1, 0}), 1);
  test::expectTrueDifferentials(PerspectiveCamera(moving, params), {320, 200});
}

TEST(PerspectiveCamera, SpreadsRayTimesOverTheShutter) {
  PerspectiveCamera::Params params = film(10, 10, 90);
  params.shutterOpen = 2;
  params.shutterClose = 6;
  const PerspectiveCamera camera(kAtOrigin, params);
  EXPECT_EQ(rayAt(camera, 5, 5, {}, 0).time, 2);
  EXPECT_EQ(rayAt(camera, 5, 5, {}, 0.25f).time, 3);
  EXPECT_EQ(rayAt(camera, 5, 5, {}, 0.5f).time, 4);
}

TEST(PerspectiveCamera, MovesWithItsTransformAtTheTimeOfTheRay) {
  const AnimatedTransform moving(Transform::translate({0, 0, 0}), 0, Transform::translate({8, 0, 0}), 4);
  PerspectiveCamera::Params params = film(10, 10, 90);
  params.shutterOpen = 1;
  params.shutterClose = 3;
  const PerspectiveCamera camera(moving, params);
  expectNear(rayAt(camera, 5, 5, {}, 0).o, {2, 0, 0}, 1e-6);
  expectNear(rayAt(camera, 5, 5, {}, 0.5f).o, {4, 0, 0}, 1e-6);
  expectNear(rayAt(camera, 5, 5, {}, 0.5f).d, {0, 0, 1}, kFloatRounding);
}

TEST(PerspectiveCamera, RefusesParametersOutOfRange) {
  const auto make = [](auto change) {
    PerspectiveCamera::Params params = film(10, 10, 90);
    change(params);
    return PerspectiveCamera(kAtOrigin, params);
  };
  EXPECT_THROW(make([](auto& p) { p.fov = 0; }), std::invalid_argument);
  EXPECT_THROW(make([](auto& p) { p.fov = 180; }), std::invalid_argument);
  EXPECT_THROW(make([](auto& p) { p.fov = std::nanf(""); }), std::invalid_argument);
  EXPECT_THROW(make([](auto& p) { p.lensRadius = -1; }), std::invalid_argument);
  EXPECT_THROW(make([](auto& p) { p.lensRadius = 1, p.focalDistance = 0; }), std::invalid_argument);
  EXPECT_THROW(make([](auto& p) { p.shutterOpen = 2; }), std::invalid_argument);
  EXPECT_NO_THROW(make([](auto& p) { p.focalDistance = 0; })) << "without a lens there is no focus";
  EXPECT_THROW(PerspectiveCamera(AnimatedTransform(Transform::scale(1, 0, 1)), film(10, 10, 90)),
               std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
