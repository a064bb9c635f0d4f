// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "base/rng.h"
#include "cameras/camera.h"
#include "samplers/sampler.h"

namespace pbrtmedia::test {

/// Component-wise comparison of directions and points; `tolerance` is absolute.
inline void expectNear(Vector3f found, Vec3d expected, double tolerance) {
  EXPECT_NEAR(found.x, expected.x, tolerance) << found << " instead of " << expected;
  EXPECT_NEAR(found.y, expected.y, tolerance) << found << " instead of " << expected;
  EXPECT_NEAR(found.z, expected.z, tolerance) << found << " instead of " << expected;
}

inline constexpr double kFloatRounding = 3e-7;  // a few roundings of numbers near 1

/// Leaves the differentials of `camera` out.
inline void expectTheSameRaysWithoutDifferentials(Camera& camera, Point2f fullResolution) {
  Rng rng(8);
  std::vector<std::pair<CameraSample, Camera::WeightedRay>> before;
  for (int i = 0; i < 50; ++i) {
    const Point2f film{rng.uniform() * fullResolution.x, rng.uniform() * fullResolution.y};
    const CameraSample s{film, {rng.uniform(), rng.uniform()}, rng.uniform()};
    before.emplace_back(s, camera.generateRay(s.film, s.lens, s.time));
  }
  camera.leaveOutDifferentials();
  for (const auto& [s, with] : before) {
    const Camera::WeightedRay without = camera.generateRay(s.film, s.lens, s.time);
    EXPECT_FALSE(without.ray.hasDifferentials);
    EXPECT_EQ(without.weight, with.weight);
    EXPECT_EQ(without.ray.o, with.ray.o);
    EXPECT_EQ(without.ray.d, with.ray.d);
    EXPECT_EQ(without.ray.time, with.ray.time);
  }
}

/// The auxiliary rays are the rays of the neighbouring pixels at the same lens point and time.
inline void expectTrueDifferentials(Camera&& camera, Point2f fullResolution) {
  Rng rng(7);
  for (int i = 0; i < 200; ++i) {
    const Point2f film{rng.uniform() * fullResolution.x, rng.uniform() * fullResolution.y};
    const Point2f lens{rng.uniform(), rng.uniform()};
    const float time = rng.uniform();
    const RayDifferential ray = camera.generateRay(film, lens, time).ray;
    const RayDifferential right = camera.generateRay({film.x + 1, film.y}, lens, time).ray;
    const RayDifferential below = camera.generateRay({film.x, film.y + 1}, lens, time).ray;
    ASSERT_TRUE(ray.hasDifferentials);
    EXPECT_NEAR(length(ray.d), 1, kFloatRounding);
    // film.x + 1 is rounded to float: up to 4e-6 pixels, far below the tolerance in direction.
    expectNear(ray.rxOrigin, Vec3d(right.o), 1e-6 * (1 + length(right.o)));
    expectNear(ray.ryOrigin, Vec3d(below.o), 1e-6 * (1 + length(below.o)));
    expectNear(ray.rxDirection, Vec3d(right.d), 1e-6);
    expectNear(ray.ryDirection, Vec3d(below.d), 1e-6);
  }
  expectTheSameRaysWithoutDifferentials(camera, fullResolution);
}

}  // namespace pbrtmedia::test
