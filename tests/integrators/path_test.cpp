// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/path/path.h"

#include <gtest/gtest.h>

#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using namespace test;

constexpr float kPiF = kPi;

/// A matte floor, a square emitter facing down above it, and a ray that meets the floor.
std::unique_ptr<Scene> floorUnderLamp(float kd, float lampHeight = 2) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 10), .material = kit.matte(kd)});
  const Shape* lamp =
      kit.quad({-1, -1, lampHeight}, {-1, 1, lampHeight}, {1, 1, lampHeight}, {1, -1, lampHeight});
  kit.builder.addPrimitive(
      {.shape = lamp, .material = kit.black(), .areaLights = kit.emitters(lamp, Rgb(3))});
  return kit.finish();
}
const Ray kToFloor = rayOf({4, 0.1f, 4}, {-4, -0.1f, -4});  // meets the floor below the lamp's middle

/// Irradiance from a square of half-width r, radiance L, at height h straight above, over pi L: the form
/// factor of a parallel square, four times that of a quarter seen from its corner (Lambert).
double squareFormFactor(double r, double h) {
  const double x = r / h, s = std::sqrt(1 + x * x);
  return 4 * (x / s * std::atan(x / s)) / std::numbers::pi;
}

TEST(Path, DepthZeroShowsVisibleEmissionOnly) {
  const auto scene = floorUnderLamp(0.5f);
  const auto integrator = makePath(*scene, {.maxDepth = 0});
  const Estimates lamp = estimate(*integrator, rayOf({0.1f, 0.2f, 1}, {0, 0, 1}), 10);
  EXPECT_EQ(lamp.red.mean(), 3);
  EXPECT_EQ(lamp.red.variance(), 0);
  EXPECT_EQ(estimate(*integrator, kToFloor, 100).red.mean(), 0);
  EXPECT_EQ(estimate(*integrator, rayOf({0.1f, 0.2f, 5}, {0, 0, -1}), 10).red.mean(), 0);  // the lamp's back
}

TEST(Path, DepthOneIsDirectLight) {
  const auto scene = floorUnderLamp(0.5f);
  const double truth = 0.5 * 3 * squareFormFactor(1, 2);
  const Estimates floor = estimate(*makePath(*scene, {.maxDepth = 1}), kToFloor, 1 << 15);
  const ZTest test = zTest(floor.red, truth);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  const ZTest off = zTest(floor.red, truth * 1.05);  // negative control
  EXPECT_GT(std::abs(off.z()), kMaxAbsZ) << off;
}

TEST(Path, WhatASplitLightIlluminatesDoesNotDependOnTheNumberOfLights) {
  // Light samples find the lower side of the lamp emitting, rays that hit it the upper one: the weights of
  // light samples alone decide what the floor gets, and PBRT-v3's leave out the probability of choosing the
  // lamp.
  const auto floor = [](bool withOther) {
    SceneKit kit;
    kit.builder.addPrimitive({.shape = kit.square(0, 10), .material = kit.matte(0.5f)});
    TriangleMesh::Params mesh;
    mesh.P = {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}};
    mesh.N = std::vector<Normal3f>(4, Normal3f(0, 0, -1));
    mesh.indices = {0, 1, 2, 0, 2, 3};
    const Shape* lamp =
        kit.builder.own(std::make_unique<TriangleMesh>(std::move(mesh), ShapePlacement{Transform(), true}));
    kit.builder.addPrimitive(
        {.shape = lamp, .material = kit.black(), .areaLights = kit.emitters(lamp, Rgb(3))});
    if (withOther) kit.pointLight({0, 0, 5}, 1e-9f);
    const auto scene = kit.finish();
    EXPECT_TRUE(scene->lights()[0]->isSplit());
    return estimate(*makePath(*scene, {.maxDepth = 1}), rayOf({0.3f, 0.1f, 0.5f}, {0, 0, -1}), 1 << 16).red;
  };
  const RunningStats alone = floor(false), accompanied = floor(true);
  EXPECT_GT(alone.mean(), 0.1);
  const double difference = alone.mean() - accompanied.mean(),
               error = std::hypot(alone.standardError(), accompanied.standardError());
  EXPECT_LT(std::abs(difference), kMaxAbsZ * error) << alone.mean() << " and " << accompanied.mean();
  EXPECT_LT(kMaxAbsZ * error, 0.05 * alone.mean()) << "a twentieth must be seen";
}

TEST(Path, IntersectsTheLightInTheLastVertexToo) {
  // A huge lamp close by: light samples alone, weighted by the power heuristic, would miss much.
  const auto scene = floorUnderLamp(0.5f, 0.05f);
  const double truth = 0.5 * 3 * squareFormFactor(1, 0.05);
  const Ray below = rayOf({0.3f, 0, 0.03f}, {-0.3f, 0, -0.03f});
  const ZTest test = zTest(estimate(*makePath(*scene, {.maxDepth = 1}), below, 1 << 15).red, truth);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

/// Inside a closed emitting and reflecting sphere: radiance L sum of kd^k, k = 0 .. maxDepth.
TEST(Path, FurnaceSumsItsGeometricSeries) {
  SceneKit kit;
  const Shape* wall = kit.sphere({0, 0, 0}, 1, /*reverse=*/true);
  kit.builder.addPrimitive(
      {.shape = wall, .material = kit.matte(0.5f), .areaLights = kit.emitters(wall, Rgb(1))});
  const auto scene = kit.finish();
  double truth = 1;
  for (int depth = 1; depth <= 6; ++depth) {
    truth += std::pow(0.5, depth);
    const ZTest test = zTest(
        estimate(*makePath(*scene, {.maxDepth = depth}), rayOf({0.1f, 0.2f, 0}, {1, 2, 3}), 1 << 13).red,
        truth);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "depth " << depth << ": " << test;
  }
}

TEST(Path, ConvexBodyUnderAWhiteSkyHasItsReflectance) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .material = kit.matte(0.5f)});
  kit.sky(1);
  const auto scene = kit.finish();
  const Estimates e = estimate(*makePath(*scene), rayOf({0.3f, 0.2f, 5}, {0, 0, -1}), 64);
  for (const Rgb& value : e.values) EXPECT_NEAR(value.r, 0.5f, 1e-5f);  // BSDF sampling is perfect here
  EXPECT_EQ(estimate(*makePath(*scene), rayOf({3, 0, 5}, {0, 0, -1}), 4).red.mean(), 1);
}

TEST(Path, PointLightFollowsTheInverseSquare) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 10), .material = kit.matte(0.5f)});
  kit.pointLight({0, 0, 2}, 1);
  const auto scene = kit.finish();
  const Estimates e = estimate(*makePath(*scene, {.maxDepth = 1}), rayOf({3, 0, 3}, {-1, 0, -1}), 8);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(e.values[i].r, 0.5f / kPiF / 4, 1e-6f);
}

TEST(Path, RouletteDoesNotChangeTheMean) {
  SceneKit kit;
  const Shape* wall = kit.sphere({0, 0, 0}, 1, /*reverse=*/true);
  kit.builder.addPrimitive(
      {.shape = wall, .material = kit.matte(0.7f), .areaLights = kit.emitters(wall, Rgb(1))});
  const auto scene = kit.finish();
  const Ray ray = rayOf({0.1f, 0.2f, 0}, {1, 2, 3});
  const Estimates with = estimate(*makePath(*scene, {.maxDepth = 40, .rrThreshold = 1}), ray, 1 << 14);
  const Estimates without = estimate(*makePath(*scene, {.maxDepth = 40, .rrThreshold = 0}), ray, 1 << 12, 2);
  const ZTest same = zTest(with.red, without.red);
  EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << same;
  const double bouncesWith = static_cast<double>(with.counters.surfaceScatterings) / (1 << 14);
  const double bouncesWithout = static_cast<double>(without.counters.surfaceScatterings) / (1 << 12);
  EXPECT_NEAR(bouncesWithout, 40, 0.5);
  EXPECT_LT(bouncesWith, 12);
  EXPECT_GT(bouncesWith, 4);  // not before bounce index 3
}

TEST(Path, PassesAndDoesNotShadowWithSurfacesWithoutMaterial) {
  const auto bare = floorUnderLamp(0.5f);
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  kit.builder.addPrimitive({.shape = kit.square(0, 10), .material = kit.matte(0.5f)});
  const Shape* lamp = kit.quad({-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2});
  kit.builder.addPrimitive(
      {.shape = lamp, .material = kit.black(), .areaLights = kit.emitters(lamp, Rgb(3))});
  kit.builder.addPrimitive({.shape = kit.square(1, 9), .media = {fog, nullptr}});
  kit.builder.addPrimitive({.shape = kit.square(1.5f, 9)});
  const auto veiled = kit.finish();
  const Estimates a = estimate(*makePath(*bare), kToFloor, 64),
                  b = estimate(*makePath(*veiled), kToFloor, 64);
  EXPECT_EQ(a.values, b.values);
}

TEST(Path, EqualsVolPathWhereThereAreNoMedia) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 10), .material = kit.matte(0.5f)});
  kit.builder.addPrimitive({.shape = kit.sphere({0.5f, 0, 0.7f}, 0.6f), .material = kit.matte(0.8f)});
  const Shape* lamp = kit.quad({-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2});
  kit.builder.addPrimitive(
      {.shape = lamp, .material = kit.black(), .areaLights = kit.emitters(lamp, Rgb(3))});
  kit.pointLight({3, 3, 3}, 5);
  kit.sky(0.1f);
  const auto scene = kit.finish();
  EXPECT_EQ(estimate(*makePath(*scene), kToFloor, 64).values,
            estimate(*makeVolPath(*scene), kToFloor, 64).values);
}

TEST(Path, ObjectsWithLightsAreSeenButDoNotIlluminate) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 10), .material = kit.matte(0.5f)});
  const Shape* lamp = kit.quad({-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2});
  const auto object = kit.builder.addObject(
      {{.shape = lamp, .material = kit.black(), .areaLights = kit.emitters(lamp, Rgb(3))}});
  kit.builder.addInstance(object, AnimatedTransform());
  const auto scene = kit.finish();
  EXPECT_TRUE(scene->lights().empty());
  EXPECT_EQ(estimate(*makePath(*scene), rayOf({0.1f, 0.2f, 1}, {0, 0, 1}), 4).red.mean(), 3);
  EXPECT_EQ(estimate(*makePath(*scene), kToFloor, 256).red.mean(), 0);
}

}  // namespace
}  // namespace pbrtmedia
