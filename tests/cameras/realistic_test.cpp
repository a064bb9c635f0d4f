// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/realistic.h"

#include <cmath>
#include <numbers>

#include "cameras/camera_test_support.h"

namespace pbrtmedia {
namespace {

using test::expectNear;

constexpr double kStopRadius = 0.003;

/// A biconvex lens before its stop, wide enough that only the stop cuts rays off.
LensSystem lens(double frontAperture = 0.03) {
  return LensSystem({{0.05, 0.02, 1.6, frontAperture}, {-0.08, 0.004, 1, 0.03}, {0, 0.05, 1, kStopRadius}});
}

RealisticCamera::Params params() {
  RealisticCamera::Params p;
  p.fullResolution = {400, 300};
  p.filmDiagonal = 0.01;
  p.focusDistance = 2;
  return p;
}

struct LensSum {
  double mean = 0;
  int stopped = 0;
};

/// Mean weight over a grid of the lens.
LensSum overLens(const RealisticCamera& camera, Point2f film, int n = 400) {
  LensSum sum;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Point2f u{(static_cast<float>(i) + 0.5f) / static_cast<float>(n),
                      (static_cast<float>(j) + 0.5f) / static_cast<float>(n)};
      const float weight = camera.generateRay(film, u, 0).weight;
      sum.mean += weight / (double(n) * n);
      sum.stopped += weight == 0 ? 1 : 0;
    }
  }
  return sum;
}

TEST(RealisticCamera, RaysOfAFilmPointMeetAtTheFocusDistance) {
  const RealisticCamera camera(AnimatedTransform(), lens(), params());
  for (const Point2f film : {Point2f(200, 150), Point2f(150, 160)}) {
    const auto chief = camera.generateRay(film, {0.5f, 0.5f}, 0);
    ASSERT_GT(chief.weight, 0);
    const auto at = [](const Ray& ray, double z) {
      return Vec3d(ray.o) + (z - ray.o.z) / ray.d.z * Vec3d(ray.d);
    };
    for (const Point2f u : {Point2f(0.3f, 0.5f), Point2f(0.6f, 0.35f), Point2f(0.5f, 0.7f)}) {
      const auto ray = camera.generateRay(film, u, 0);
      ASSERT_GT(ray.weight, 0);
      EXPECT_LT(length(at(ray.ray, 2) - at(chief.ray, 2)), 3e-4);
      EXPECT_GT(length(at(ray.ray, 1) - at(chief.ray, 1)), 4e-4) << "before the focus they are apart";
    }
  }
}

TEST(RealisticCamera, PictureIsUpright) {
  const RealisticCamera camera(AnimatedTransform(), lens(), params());
  const Vector3f left = camera.generateRay({0, 150}, {0.5f, 0.5f}, 0).ray.d;
  const Vector3f top = camera.generateRay({200, 0}, {0.5f, 0.5f}, 0).ray.d;
  EXPECT_LT(left.x, -0.01f);
  EXPECT_NEAR(left.y, 0, 1e-6);
  EXPECT_GT(top.y, 0.01f);
  EXPECT_NEAR(top.x, 0, 1e-6);
  // Three fourths as high as wide, seen through one lens.
  EXPECT_NEAR(top.y / -left.x, 0.75, 0.01);
}

TEST(RealisticCamera, ExposureIsThatOfADisk) {
  // Irradiance at the film's centre under radiance 1 through a disk: pi r² / (r² + z²), times the shutter.
  RealisticCamera::Params p = params();
  p.simpleWeighting = false;
  p.shutterOpen = 1;
  p.shutterClose = 3;
  const RealisticCamera camera(AnimatedTransform(), lens(), p);
  const double z = lens().focusedAt(p.focusDistance, 1e-3 * p.filmDiagonal).rearZ();
  const LensSum sum = overLens(camera, {200, 150});
  const double expected =
      2 * std::numbers::pi * kStopRadius * kStopRadius / (kStopRadius * kStopRadius + z * z);
  EXPECT_NEAR(sum.mean, expected, 2e-3 * expected);
}

TEST(RealisticCamera, SimpleWeightsAreTheShareOfTheRectangle) {
  const RealisticCamera camera(AnimatedTransform(), lens(), params());
  const double z = lens().focusedAt(2, 1e-5).rearZ();
  const ExitPupil pupil(lens().focusedAt(2, 1e-3 * params().filmDiagonal), params().filmDiagonal / 2);
  const double disk =
      std::numbers::pi * kStopRadius * kStopRadius / (1 + kStopRadius * kStopRadius / (z * z));
  const LensSum sum = overLens(camera, {200, 150});
  EXPECT_NEAR(sum.mean, disk / pupil.centralArea(), 2e-3);
  EXPECT_GT(sum.stopped, 1000) << "the corners of the rectangle";
  // Off the axis cos⁴, and nothing else: the weights do not show how tight the rectangle is.
  const double x = 200 * 0.8 * params().filmDiagonal / 400, cosine = z / std::hypot(x, z);
  EXPECT_NEAR(overLens(camera, {0, 150}).mean / sum.mean, std::pow(cosine, 4), 4e-3);
}

TEST(RealisticCamera, RaysThatTheLensStopsHaveNoWeight) {
  const RealisticCamera narrow(AnimatedTransform(), lens(0.0032), params());
  const RealisticCamera wide(AnimatedTransform(), lens(), params());
  EXPECT_LT(overLens(narrow, {0, 0}, 100).mean, 0.95 * overLens(wide, {0, 0}, 100).mean);
  const auto stopped = wide.generateRay({200, 150}, {0.001f, 0.001f}, 0.25f);
  EXPECT_EQ(stopped.weight, 0);
  EXPECT_NEAR(length(stopped.ray.d), 1, 1e-6);
  EXPECT_EQ(stopped.ray.time, 0.25f);
}

TEST(RealisticCamera, DifferentialsAreThoseOfNeighbouringPixels) {
  const AnimatedTransform place(Transform::translate({1, 2, 3}) * Transform::rotate(30, {0, 1, 0}));
  RealisticCamera camera(place, lens(), params());
  Rng rng(7);
  for (int i = 0; i < 100; ++i) {
    const Point2f film{20 + 360 * rng.uniform(), 20 + 260 * rng.uniform()},
        u{0.3f + 0.4f * rng.uniform(), 0.5f};
    const auto ray = camera.generateRay(film, u, 0), right = camera.generateRay({film.x + 1, film.y}, u, 0),
               below = camera.generateRay({film.x, film.y + 1}, u, 0);
    ASSERT_TRUE(ray.ray.hasDifferentials);
    const double pixel = length(right.ray.d - ray.ray.d);
    expectNear(ray.ray.rxDirection, Vec3d(right.ray.d), 0.05 * pixel);
    expectNear(ray.ray.ryDirection, Vec3d(below.ray.d), 0.05 * pixel);
    expectNear(ray.ray.rxOrigin, Vec3d(right.ray.o), 2e-5);
    expectNear(ray.ray.ryOrigin, Vec3d(below.ray.o), 2e-5);
  }
  test::expectTheSameRaysWithoutDifferentials(camera, {400, 300});
}

TEST(RealisticCamera, HasNoImportance) {
  const RealisticCamera camera(AnimatedTransform(), lens(), params());
  EXPECT_FALSE(camera.hasImportance());
  EXPECT_EQ(camera.we(camera.generateRay({200, 150}, {0.5f, 0.5f}, 0).ray).value, 0);
  EXPECT_EQ(camera.sampleWi({0, 0, 2}, {0.5f, 0.5f}, 0).pdf, 0);
}

TEST(RealisticCamera, RejectsAFilmWithoutSize) {
  RealisticCamera::Params p = params();
  p.filmDiagonal = 0;
  EXPECT_THROW(RealisticCamera(AnimatedTransform(), lens(), p), std::invalid_argument);
  p.filmDiagonal = -0.01;
  EXPECT_THROW(RealisticCamera(AnimatedTransform(), lens(), p), std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
