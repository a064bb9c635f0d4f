// SPDX-License-Identifier: BSD-2-Clause
#include "world/scatter_point.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"
#include "base/warp.h"
#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using test::rayOf;

const BoundaryPlane kFloor{true, {1, 2, 0}, {0, 0, 1}, 2};

TEST(ScatterPoint, AwayFromBoundariesIsThePointOfTheRay) {
  RenderCounters counters;
  const ScatterPoint at = scatterPoint(rayOf({1, 2, 3}, {0, 0, -1}), 2, kFloor, {}, counters);
  EXPECT_EQ(at.p, Point3f(1, 2, 1));
  EXPECT_FALSE(at.near.isValid);
  EXPECT_EQ(at.endAlong({0, 0, -1}, 1), 1);
  EXPECT_EQ(counters.boundaryRepairs, 0u);
}

TEST(ScatterPoint, KeepsAHeightThatSinglePrecisionCannotTell) {
  RenderCounters counters;
  for (const double height : {1e-7, 1e-10, 1e-14}) {
    const ScatterPoint at = scatterPoint(rayOf({1, 2, 1}, {0, 0, -1}), 1 - height, kFloor, {}, counters);
    ASSERT_TRUE(at.near.isValid);
    EXPECT_NEAR(at.height, height, 2e-16);
    EXPECT_GT(at.p.z, 1e-7f);
    EXPECT_NEAR(at.height + at.near.offset, double{at.p.z}, 2e-16);
    // Straight down to the floor it is as far as from the true point; along a slope of half twice as far.
    EXPECT_NEAR(at.endAlong({0, 0, -1}, double{at.p.z} * (1 + 1e-3)), height, 2e-16);
    const Vector3f slope(std::sqrt(.75f), 0, -.5f);
    EXPECT_NEAR(at.endAlong(slope, 2 * double{at.p.z}), 2 * height, 1e-15);
    // From there up and a little down again, heights go on from the true one.
    const ScatterPoint up = scatterPoint(rayOf(at.p, {0, 0, 1}), 1e-9, at.near, {}, counters);
    EXPECT_NEAR(up.height, height + 1e-9, 4e-16);
  }
  EXPECT_EQ(counters.boundaryRepairs, 0u);
}

TEST(ScatterPoint, LeavesAHitOfAnotherSurfaceAlone) {
  RenderCounters counters;
  const ScatterPoint at = scatterPoint(rayOf({1, 2, 1}, {0, 0, -1}), 1 - 1e-9, kFloor, {}, counters);
  EXPECT_EQ(at.endAlong({0, 0, -1}, 1), 1);
  EXPECT_EQ(at.endAlong({0, 0, 1}, 1), 1);
}

TEST(ScatterPoint, BeyondItsBoundaryIsARepair) {
  RenderCounters counters;
  const ScatterPoint at = scatterPoint(rayOf({1, 2, 1}, {0, 0, -1}), 1 + 1e-9, kFloor, {}, counters);
  EXPECT_EQ(counters.boundaryRepairs, 1u);
  EXPECT_EQ(at.height, 0);
  EXPECT_GT(at.p.z, 0.0f);
}

/// A walk in a half-space of extinction sigma, absorbed with probability 1/2 at each collision: how many come
/// out depends on nothing but the albedo.
double shareThatReturns(double sigma, int walks) {
  RenderCounters counters;
  Rng rng(20261129);
  int returned = 0;
  for (int i = 0; i < walks; ++i) {
    Ray ray = rayOf({.3f, .2f, 1}, {0, 0, -1});
    BoundaryPlane plane{true, {.3, .2, 0}, {0, 0, -1}, 1};  // the medium is below
    double begin = 1, end = 1e30;
    for (;;) {
      const double t = begin + rng.exponential() / sigma;
      if (t >= end) {
        ++returned;
        break;
      }
      if (rng.uniform() < .5f) break;
      const ScatterPoint at = scatterPoint(ray, t, plane, {}, counters);
      const float u = rng.uniform();
      const Vector3f d = sampleUniformSphere({u, rng.uniform()});
      const double hit = d.z > 0 ? double{-at.p.z} / double{d.z} : 1e30;
      begin = 0;
      end = at.endAlong(d, hit);
      ray = rayOf(at.p, d);
      plane = at.near.isValid ? at.near : BoundaryPlane{true, {.3, .2, 0}, {0, 0, -1}, 1};
    }
  }
  return static_cast<double>(returned) / walks;
}

TEST(ScatterPoint, WalksComeOutAsOftenHoweverDenseTheMedium) {
  constexpr int kWalks = 100000;
  const double expected = shareThatReturns(10, kWalks);
  const double error = std::sqrt(2 * expected * (1 - expected) / kWalks);
  for (const double sigma : {1e4, 1e6, 1e8, 1e11}) {
    EXPECT_LT(std::abs(shareThatReturns(sigma, kWalks) - expected), 5 * error) << sigma;
  }
}

}  // namespace
}  // namespace pbrtmedia
