// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/path/vol_path.h"

#include <gtest/gtest.h>

#include "media/grid_medium.h"
#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using namespace test;
using Mode = OverlapRule::Mode;

/// Fog in a box under a white sky, with a matte ball in it; `shells` around the ball, or tiny ones aside.
std::unique_ptr<Scene> foggyBall(Rgb sigmaA, Rgb sigmaS, int shells, bool aside = false) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", sigmaA, sigmaS);
  kit.builder.addPrimitive({.shape = kit.box({-2, -2, -2}, {2, 2, 2}), .media = {fog, nullptr}});
  kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .material = kit.matte(0.5f)});
  for (int i = 0; i < shells; ++i) {
    const float size = 1.1f + 0.008f * static_cast<float>(i);
    kit.builder.addPrimitive(
        {.shape = aside ? kit.sphere({1.99f, 1.99f, 1.99f}, 0.001f * size) : kit.sphere({0, 0, 0}, size)});
  }
  kit.sky(1);
  kit.pointLight({0, 3, 1}, 4);
  return kit.finish();
}
const Ray kThroughFog = rayOf({0.3f, 0.2f, 5}, {0.05f, 0.02f, -1});

TEST(VolPath, EmptyShellsChangeNothingAtAll) {
  // As many shells in both: few shapes are met otherwise than many, to the last digit.
  const auto bare = foggyBall(Rgb(0.1f), Rgb(0.5f), 200, /*aside=*/true),
             shelled = foggyBall(Rgb(0.1f), Rgb(0.5f), 200);
  const PathParams params{.maxDepth = 3};
  EXPECT_EQ(estimate(*makeVolPath(*bare, params), kThroughFog, 64).values,
            estimate(*makeVolPath(*shelled, params), kThroughFog, 64).values);
}

TEST(VolPath, CoincidentSlabsTransmitExactly) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  for (int i = 0; i < 3; ++i) {
    const auto z = static_cast<float>(i);
    kit.builder.addPrimitive({.shape = kit.box({-5, -5, z}, {5, 5, z + 1}), .media = {fog, nullptr}});
  }
  kit.sky(1);
  const auto scene = kit.finish();
  const Estimates e = estimate(*makeVolPath(*scene, {.maxDepth = 0}), rayOf({0.3f, 0.2f, 5}, {0, 0, -1}), 4);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(e.values[i].r, std::exp(-3.0), 1e-7);
  // What only absorbs dims paths of every depth the same.
  const Estimates deep = estimate(*makeVolPath(*scene), rayOf({0.3f, 0.2f, 5}, {0, 0, -1}), 4);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(deep.values[i].r, std::exp(-3.0), 1e-7);
}

TEST(VolPath, FlightsCrossCoincidentSlabsLikeOne) {
  // Furnace: a flight that lost its medium at a shared face, or kept it, would be dimmed wrongly.
  const auto seen = [](int slabs) {
    SceneKit kit;
    const Medium* fog = kit.fog("fog", Rgb(.5f), Rgb(.5f));
    for (int i = 0; i < slabs; ++i) {
      const float z0 = 3.0f * static_cast<float>(i) / static_cast<float>(slabs),
                  z1 = 3.0f * static_cast<float>(i + 1) / static_cast<float>(slabs);
      kit.builder.addPrimitive({.shape = kit.box({-5, -5, z0}, {5, 5, z1}), .media = {fog, nullptr}});
    }
    kit.sky(1);
    const auto scene = kit.finish();
    return estimate(*makeVolPath(*scene), rayOf({0.3f, 0.2f, 5}, {0, 0, -1}), 1 << 15, 7 + slabs).red;
  };
  const ZTest test = zTest(seen(1), seen(3));
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_GT(std::abs(zTest(seen(1), 1.05 * seen(3).mean()).z()), kMaxAbsZ) << "five percent are seen";
}

/// Everything is as bright as the sky where nothing absorbs, whatever the optical depth.
TEST(VolPath, FurnaceStaysWhite) {
  for (const float sigma : {0.01f, 1.0f, 10.0f}) {
    SceneKit kit;
    const Medium* fog = kit.fog("fog", Rgb(0), Rgb(sigma));
    kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .media = {fog, nullptr}});
    kit.sky(1);
    const auto scene = kit.finish();
    const ZTest test = zTest(
        estimate(*makeVolPath(*scene, {.maxDepth = 100000}), rayOf({0.3f, 0.2f, 5}, {0, 0, -1}), 1 << 10).red,
        1);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "sigma " << sigma << ": " << test;
  }
}

TEST(VolPath, ChromaticFurnaceStaysWhite) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(0), Rgb(0.2f, 1, 4));
  kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .media = {fog, nullptr}});
  kit.sky(1);
  const auto scene = kit.finish();
  const Estimates e =
      estimate(*makeVolPath(*scene, {.maxDepth = 100000}), rayOf({0.3f, 0.2f, 5}, {0, 0, -1}), 1 << 14);
  for (const RunningStats* channel : {&e.red, &e.green, &e.blue}) {
    const ZTest test = zTest(*channel, 1);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  }
}

/// Single scattering of a point light through a thin slab of fog seen edge-on has a closed form in one
/// dimension: with the light on the ray's side at distance h from the line, radiance is the integral of
/// sigma_s/(4 pi) I exp(-sigma_t (t + r(t)))/r(t)² over the segment, r = distance to the light inside the
/// fog.
TEST(VolPath, DepthOneInAMediumIsSingleScattering) {
  constexpr double kSigmaT = 0.6, kSigmaS = 0.4;
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(0.2f), Rgb(0.4f));
  kit.builder.addPrimitive({.shape = kit.box({-50, -50, -2}, {50, 50, 2}), .media = {fog, nullptr}});
  kit.pointLight({0, 1, 0}, 2);
  const auto scene = kit.finish();
  double truth = 0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * 4 / kSteps, z = 2 - t, r2 = 1 + z * z;
    truth +=
        kSigmaS / (4 * std::numbers::pi) * 2 * std::exp(-kSigmaT * (t + std::sqrt(r2))) / r2 * 4 / kSteps;
  }
  const Ray ray = rayOf({0, 0, 5}, {0, 0, -1});
  const Estimates one = estimate(*makeVolPath(*scene, {.maxDepth = 1}), ray, 1 << 16);
  const ZTest test = zTest(one.red, truth);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  const ZTest more = zTest(estimate(*makeVolPath(*scene, {.maxDepth = 8}), ray, 1 << 16).red, truth);
  EXPECT_GT(more.z(), kMaxAbsZ) << more;  // negative control: multiple scattering adds light
  EXPECT_EQ(estimate(*makeVolPath(*scene, {.maxDepth = 0}), ray, 100).red.mean(), 0);
}

TEST(VolPath, AreaLightInAMediumAgreesWithItsOwnWeightsAtEveryDepth) {
  // Light sampling and scattering share the work differently for a near and a far lamp; a one-sided box of
  // fog around a lamp of radiance 1 that fills the whole sphere of directions is a furnace again.
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(0), Rgb(2));
  const Shape* wall = kit.sphere({0, 0, 0}, 1, /*reverse=*/true);
  kit.builder.addPrimitive({.shape = wall,
                            .material = kit.black(),
                            .media = {nullptr, fog},
                            .areaLights = kit.emitters(wall, Rgb(1))});
  const auto scene = kit.finish();
  const ZTest test = zTest(estimate(*makeVolPath(*scene, {.maxDepth = 1000}, std::nullopt),
                                    rayOf({0.1f, 0.2f, 0}, {1, 2, 3}), 1 << 13)
                               .red,
                           1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST(VolPath, RouletteInMediaDoesNotChangeTheMean) {
  const auto scene = foggyBall(Rgb(0.9f), Rgb(0.3f), 0);
  const Estimates with =
      estimate(*makeVolPath(*scene, {.maxDepth = 30, .rrThreshold = 1}), kThroughFog, 1 << 16);
  const Estimates without =
      estimate(*makeVolPath(*scene, {.maxDepth = 30, .rrThreshold = 0}), kThroughFog, 1 << 16, 2);
  const ZTest same = zTest(with.red, without.red);
  EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << same;
  EXPECT_LT(with.counters.mediumScatterings, without.counters.mediumScatterings);
}

TEST(VolPath, AddedOverlapEqualsOneMediumOfTheSum) {
  const auto build = [](bool split) {
    SceneKit kit;
    const Shape* ball = kit.sphere({0, 0, 0}, 1);
    if (split) {
      const Medium* a = kit.fog("a", Rgb(0.1f), Rgb(0.9f), {Mode::Add});
      const Medium* b = kit.fog("b", Rgb(0.3f), Rgb(0.4f), {Mode::Add});
      kit.builder.addPrimitive({.shape = ball, .media = {a, nullptr}});
      kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .media = {b, nullptr}});
    } else {
      kit.builder.addPrimitive({.shape = ball, .media = {kit.fog("sum", Rgb(0.4f), Rgb(1.3f)), nullptr}});
    }
    kit.sky(1);
    return kit.finish();
  };
  const auto one = build(false), two = build(true);
  const Ray ray = rayOf({0.3f, 0.2f, 5}, {0, 0, -1});
  const Estimates a = estimate(*makeVolPath(*one), ray, 1 << 15),
                  b = estimate(*makeVolPath(*two), ray, 1 << 15, 2);
  const ZTest same = zTest(a.red, b.red);
  EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << same;
  EXPECT_EQ(b.counters.mediumMismatches, 0u);
}

TEST(VolPath, InstancedMediaEqualCopies) {
  const Transform place =
      Transform::translate({1, 2, 3}) * Transform::rotate(30, {0, 1, 1}) * Transform::scale(2, 1, 0.5);
  GridMediumParams grid;
  grid.sigmaA = Rgb(0.5f);
  grid.sigmaS = Rgb(1.5f);
  grid.grid.nx = grid.grid.ny = grid.grid.nz = 2;
  grid.grid.density = {0, 1, 2, 3, 4, 5, 6, 7};
  grid.grid.p0 = {-1, -1, -1};
  grid.grid.p1 = {1, 1, 1};
  const auto build = [&](bool instanced) {
    SceneKit kit;
    const Medium* smoke = kit.builder.own(makeGridMedium(grid, instanced ? Transform() : place));
    if (instanced) {
      const auto object =
          kit.builder.addObject({{.shape = kit.box({-1, -1, -1}, {1, 1, 1}), .media = {smoke, nullptr}}});
      kit.builder.addInstance(object, AnimatedTransform(place));
    } else {
      kit.builder.addPrimitive({.shape = kit.box({-1, -1, -1}, {1, 1, 1}, place), .media = {smoke, nullptr}});
    }
    kit.sky(1);
    return kit.finish();
  };
  const auto copy = build(false), instance = build(true);
  for (const Vector3f offset : {Vector3f(0, 0, 0), Vector3f(0.4f, -0.2f, 0.1f)}) {
    const Ray ray = rayOf(Point3f(1, 2, 9) + offset, {0.02f, 0.05f, -1});
    const Estimates a = estimate(*makeVolPath(*copy), ray, 1 << 15),
                    b = estimate(*makeVolPath(*instance), ray, 1 << 15, 2);
    const ZTest same = zTest(a.red, b.red);
    EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << same;
    EXPECT_GT(a.red.variance(), 0);  // the ray does meet the smoke
  }
}

TEST(VolPath, TakesTheMediaOnBothSidesOfAScatteringSurface) {
  // A black-walled room full of absorbing fog: what a matte floor at its bottom sends up is dimmed once down,
  // once up.
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(0.5f), Rgb(0));
  kit.builder.addPrimitive(
      {.shape = kit.square(0, 50), .material = kit.matte(0.5f), .media = {nullptr, fog}});
  kit.builder.addPrimitive({.shape = kit.square(1, 50), .media = {fog, nullptr}});
  kit.pointLight({0, 0, 2}, 1);
  const auto scene = kit.finish();
  const Estimates e = estimate(*makeVolPath(*scene, {.maxDepth = 1, .rrThreshold = 0}),
                               rayOf({0, 0, 1.5f}, {0, 0, -1}), 1 << 14);
  EXPECT_NEAR(e.red.mean(), 0.5 / std::numbers::pi / 4 * std::exp(-1.0), 1e-8);
  EXPECT_LT(e.red.standardError(), 1e-9) << "nothing here is left to chance";
  EXPECT_EQ(e.counters.mediumMismatches, 0u);
}

}  // namespace
}  // namespace pbrtmedia
