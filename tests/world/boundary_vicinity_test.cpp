// SPDX-License-Identifier: BSD-2-Clause
#include "world/boundary_vicinity.h"

#include <gtest/gtest.h>

#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using test::SceneKit;

const Transform kPlace =
    Transform::translate({300, 20, -7}) * Transform::rotate(33, {1, 2, 3}) * Transform::scale(2, 2, 2);

/// A scene with the boundary, directly or in an instance under `kPlace`.
std::unique_ptr<Scene> around(SceneKit& kit, const Shape* shape, bool isInstance) {
  const Primitive boundary{.shape = shape, .media = {kit.fog("m", Rgb(1), Rgb(0)), nullptr}};
  if (isInstance) {
    kit.builder.addInstance(kit.builder.addObject({boundary}), AnimatedTransform(kPlace));
  } else {
    kit.builder.addPrimitive(boundary);
  }
  return kit.finish();
}

TEST(BoundaryVicinity, HoldsEveryPointOfABoundary) {
  for (int kind = 0; kind < 6; ++kind) {
    SceneKit kit;
    const Shape* const shape = kind / 2 == 0   ? kit.box({-1, 2, 3}, {5, 4, 9})
                               : kind / 2 == 1 ? kit.sphere({1, 2, 3}, 5)
                                               : kit.quad({0, 0, 1}, {1, 0, 0}, {1, 1, 2}, {0, 1, 3});
    const bool isInstance = kind % 2 == 1;
    const auto scene = around(kit, shape, isInstance);
    Rng rng(3);
    for (int i = 0; i < 2000; ++i) {
      const std::uint32_t primitive = static_cast<std::uint32_t>(i) % shape->primitiveCount();
      const Point3f p = shape->sample(primitive, Point2f(rng.uniform(), rng.uniform())).p;
      EXPECT_TRUE(scene->mayTouchBoundary(isInstance ? kPlace.point(p) : p)) << kind << ' ' << p;
    }
  }
}

TEST(BoundaryVicinity, KnowsHowCoarsePointsAreThatComeFromFarAway) {
  // The object is tiny and so is its place in the world, but between them its points are a thousand units
  // away.
  const Transform place = Transform::translate({-1000, -1000, -1000}) * Transform::scale(1e6, 1e6, 1e6);
  SceneKit kit;
  const Shape* const shape = kit.quad({1e-3f, 1e-3f, 1e-3f}, {1.001e-3f, 1e-3f, 1.0003e-3f},
                                      {1.001e-3f, 1.001e-3f, 1.0008e-3f}, {1e-3f, 1.001e-3f, 1.0004e-3f});
  const Primitive boundary{.shape = shape, .media = {kit.fog("m", Rgb(1), Rgb(0)), nullptr}};
  kit.builder.addInstance(kit.builder.addObject({boundary}), AnimatedTransform(place));
  const auto scene = kit.finish();
  Rng rng(5);
  for (int i = 0; i < 2000; ++i) {
    const std::uint32_t primitive = static_cast<std::uint32_t>(i) % shape->primitiveCount();
    const Point3f p = place.point(shape->sample(primitive, Point2f(rng.uniform(), rng.uniform())).p);
    EXPECT_TRUE(scene->mayTouchBoundary(p)) << p;
  }
}

TEST(BoundaryVicinity, SparesTheQueryForMostOtherPoints) {
  Rng rng(4);
  for (const bool isInstance : {false, true}) {
    SceneKit kit;
    const auto scene = around(kit, kit.box({-1, -1, -1}, {1, 1, 1}), isInstance);
    for (int i = 0; i < 2000; ++i) {
      const Point3f p(0.99f * (2 * rng.uniform() - 1), 0.99f * (2 * rng.uniform() - 1),
                      0.99f * (2 * rng.uniform() - 1));
      EXPECT_FALSE(scene->mayTouchBoundary(isInstance ? kPlace.point(p) : p)) << p;
    }
    EXPECT_FALSE(scene->mayTouchBoundary({0, 0, 500}));
  }
  SceneKit kit;
  const auto scene = around(kit, kit.sphere({1, 2, 3}, 5), false);
  EXPECT_FALSE(scene->mayTouchBoundary({1, 2, 7.9f}));
  EXPECT_FALSE(scene->mayTouchBoundary({1, 2, 8.1f}));
  EXPECT_FALSE(SceneKit().finish()->mayTouchBoundary({0, 0, 0}));
}

TEST(BoundaryVicinity, LeavesOutTheBoundaryAtHand) {
  SceneKit kit;
  const auto scene = around(kit, kit.box({-1, -1, -1}, {1, 1, 1}), false);
  std::uint64_t queries = 0;
  const auto hit = scene->closest(test::rayOf({0.3f, 0.2f, 5}, {0, 0, -1}), 0, {}, queries);
  ASSERT_TRUE(hit);
  EXPECT_TRUE(scene->mayTouchBoundary({0.3f, 0.2f, 1}));
  EXPECT_FALSE(scene->mayTouchBoundary({0.3f, 0.2f, 1}, *hit));
}

TEST(BoundaryVicinity, SaysYesWhereItDoesNotKnow) {
  SceneKit kit;
  const Medium* m = kit.fog("m", Rgb(1), Rgb(0));
  for (int i = 0; i < 70; ++i) {
    kit.builder.addPrimitive({.shape = kit.square(static_cast<float>(i), 1), .media = {m, nullptr}});
  }
  EXPECT_TRUE(kit.finish()->mayTouchBoundary({0, 0, 100}));
}

}  // namespace
}  // namespace pbrtmedia
