// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <gtest/gtest.h>

#include "base/rng.h"
#include "cameras/camera.h"

namespace pbrtmedia::test {

/// Component-wise comparison of directions and points; `tolerance` is absolute.
inline void expectNear(Vector3f found, Vec3d expected, double tolerance) {
  EXPECT_NEAR(found.x, expected.x, tolerance) << found << " instead of " << expected;
  EXPECT_NEAR(found.y, expected.y, tolerance) << found << " instead of " << expected;
  EXPECT_NEAR(found.z, expected.z, tolerance) << found << " instead of " << expected;
}

inline constexpr double kFloatRounding = 3e-7;  // a few roundings of numbers near 1

/// The auxiliary rays are the rays of the neighbouring pixels at the same lens point and time.
inline void expectTrueDifferentials(const Camera& camera, Point2f fullResolution) {
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
}

}  // namespace pbrtmedia::test
