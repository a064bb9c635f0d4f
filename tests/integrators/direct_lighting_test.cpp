// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/direct/direct_lighting.h"

#include <gtest/gtest.h>

#include "integrators/direct/specular_recursion.h"
#include "integrators/direct/whitted.h"
#include "materials/glass.h"
#include "materials/mirror.h"
#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using namespace test;
using Strategy = DirectLightingParams::Strategy;

std::unique_ptr<Scene> lampsOverFloor() {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 10), .material = kit.matte(0.5f)});
  const Shape* lamp = kit.quad({-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2});
  kit.builder.addPrimitive(
      {.shape = lamp, .material = kit.black(), .areaLights = kit.emitters(lamp, Rgb(3), false, 4)});
  kit.pointLight({2, 1, 3}, 4);
  kit.sky(0.2f);
  return kit.finish();
}
const Ray kToFloor = rayOf({4, 0.1f, 4}, {-4, -0.1f, -4});

TEST(DirectLighting, AllAndOneHaveTheMeanOfPathAtDepthOne) {
  const auto scene = lampsOverFloor();
  const DirectLightingIntegrator all(*scene, {.strategy = Strategy::All}),
      one(*scene, {.strategy = Strategy::One});
  const Estimates path = estimate(*makePath(*scene, {.maxDepth = 1}), kToFloor, 1 << 15);
  const ZTest a = zTest(estimate(all, kToFloor, 1 << 13, 2).red, path.red);
  const ZTest b = zTest(estimate(one, kToFloor, 1 << 15, 3).red, path.red);
  EXPECT_LT(std::abs(a.z()), kMaxAbsZ) << a;
  EXPECT_LT(std::abs(b.z()), kMaxAbsZ) << b;
}

TEST(DirectLighting, TakesAsManySamplesAsTheLightAsksFor) {
  const auto scene = lampsOverFloor();
  const DirectLightingIntegrator all(*scene, {.strategy = Strategy::All});
  const Estimates e = estimate(all, kToFloor, 100);
  // Two emitting triangles of 4 samples, a point light and the sky; some samples of the sky lie below the
  // floor.
  EXPECT_GT(e.counters.shadowRays, 100u * 9);
  EXPECT_LE(e.counters.shadowRays, 100u * 10);
}

TEST(Whitted, LightsByOneSampleOfEveryLight) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 10), .material = kit.matte(0.5f)});
  kit.pointLight({0, 0, 2}, 1);
  kit.pointLight({0, 0, 4}, 1);
  const auto scene = kit.finish();
  const WhittedIntegrator whitted(*scene, {});
  const Estimates e = estimate(whitted, rayOf({3, 0, 3}, {-1, 0, -1}), 4);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(e.values[i].r, 0.5f / kPi * (1.0f / 4 + 1.0f / 16), 1e-6f);
}

TEST(Whitted, HasTheMeanOfPathForAreaLights) {
  const auto scene = lampsOverFloor();
  const ZTest test = zTest(estimate(WhittedIntegrator(*scene, {}), kToFloor, 1 << 15).red,
                           estimate(*makePath(*scene, {.maxDepth = 1}), kToFloor, 1 << 15, 2).red);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

/// Two mirrors face each other; the sky is seen through the gap after a number of reflections.
TEST(Whitted, DepthLimitsTheLevelsOfRecursion) {
  SceneKit kit;
  const RgbTexture* kr = kit.builder.own(std::make_unique<ConstantTexture<Rgb>>(Rgb(0.5f)));
  const Material* mirror = kit.builder.own(std::make_unique<MirrorMaterial>(MirrorParams{.kr = kr}));
  kit.builder.addPrimitive({.shape = kit.square(0, 10), .material = mirror});
  kit.sky(1);
  const auto scene = kit.finish();
  const Ray down = rayOf({0.1f, 0.2f, 1}, {0.3f, 0, -1});
  EXPECT_EQ(estimate(WhittedIntegrator(*scene, {.maxDepth = 1}), down, 1).red.mean(), 0);
  EXPECT_NEAR(estimate(WhittedIntegrator(*scene, {.maxDepth = 2}), down, 1).red.mean(), 0.5, 1e-6);
  EXPECT_EQ(estimate(DirectLightingIntegrator(*scene, {.maxDepth = 1}), down, 1).red.mean(), 0);
  EXPECT_NEAR(estimate(DirectLightingIntegrator(*scene, {.maxDepth = 2}), down, 1).red.mean(), 0.5, 1e-6);
  // path counts vertices: one reflection is depth 1.
  EXPECT_NEAR(estimate(*makePath(*scene, {.maxDepth = 1}), down, 1).red.mean(), 0.5, 1e-6);
  EXPECT_EQ(estimate(*makePath(*scene, {.maxDepth = 0}), down, 1).red.mean(), 0);
}

/// A sphere that mirrors and emits inside: after k reflections L Kr^k is seen.
std::unique_ptr<Scene> shiningMirror(float kr) {
  SceneKit kit;
  const RgbTexture* texture = kit.builder.own(std::make_unique<ConstantTexture<Rgb>>(Rgb(kr)));
  const Material* mirror = kit.builder.own(std::make_unique<MirrorMaterial>(MirrorParams{.kr = texture}));
  const Shape* sphere = kit.sphere({0, 0, 0}, 5, /*reverse=*/true);
  kit.builder.addPrimitive({.shape = sphere, .material = mirror, .areaLights = kit.emitters(sphere, Rgb(1))});
  return kit.finish();
}

TEST(SpecularRecursion, HasAnyNumberOfLevels) {
  constexpr float kKr = 0.999f;
  const auto scene = shiningMirror(kKr);
  const Ray ray = rayOf({0.1f, 0.2f, 1}, {0.3f, 0.5f, -1});
  for (const int levels :
       {1, 10, SpecularRecursion::kExactLevels - 1, SpecularRecursion::kExactLevels,
        SpecularRecursion::kExactLevels + 1, 3 * SpecularRecursion::kExactLevels, 200000}) {
    const double truth = (1 - std::pow(double{kKr}, levels)) / (1 - double{kKr});
    EXPECT_NEAR(estimate(WhittedIntegrator(*scene, {.maxDepth = levels}), ray, 1).red.mean(), truth,
                1e-3 * truth)
        << levels;
    EXPECT_NEAR(estimate(DirectLightingIntegrator(*scene, {.maxDepth = levels}), ray, 1).red.mean(), truth,
                1e-3 * truth)
        << levels;
  }
}

TEST(SpecularRecursion, LeavesWhatIsTooDimForAFloat) {
  const auto scene = shiningMirror(0.5f);
  const Estimates e =
      estimate(WhittedIntegrator(*scene, {.maxDepth = 10000000}), rayOf({0.1f, 0, 1}, {0, 1, 0}), 1);
  EXPECT_NEAR(e.red.mean(), 2, 1e-5);
  EXPECT_LE(e.counters.rays, SpecularRecursion::kExactLevels + 2u);
}

/// Two rays at every hit of a glass ball under a white sky: all of it arrives, however near to the rim, where
/// light goes round thousands of times.
TEST(SpecularRecursion, FollowsBothRaysOfGlassAtAnyLevel) {
  SceneKit kit;
  const RgbTexture* white = kit.builder.own(std::make_unique<ConstantTexture<Rgb>>(Rgb(1)));
  const FloatTexture* eta = kit.builder.own(std::make_unique<ConstantTexture<float>>(1.5f));
  const FloatTexture* zero = kit.builder.own(std::make_unique<ConstantTexture<float>>(0.0f));
  const Material* glass = kit.builder.own(std::make_unique<GlassMaterial>(
      GlassParams{.kr = white, .kt = white, .eta = eta, .uRoughness = zero, .vRoughness = zero}));
  kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .material = glass});
  kit.sky(1);
  const auto scene = kit.finish();
  const WhittedIntegrator deep(*scene, {.maxDepth = 1000000});
  for (const float off : {0.0f, 0.5f, 0.9f, 0.999f}) {
    EXPECT_NEAR(estimate(deep, rayOf({off, 0.01f, 4}, {0, 0, -1}), 1).red.mean(), 1, 1e-4) << off;
  }
  const Estimates rim = estimate(deep, rayOf({0.99999994f, 0, 4}, {0, 0, -1}), 1);
  EXPECT_NEAR(rim.red.mean(), 1, 1e-3);
  EXPECT_GT(rim.counters.surfaceScatterings, SpecularRecursion::kExactLevels + 100u);
}

// ---- Ray differentials
// -------------------------------------------------------------------------------------

/// A camera ray on a sphere, its surface point, and the exact outcome for a neighbouring ray.
struct Footprint {
  SceneKit kit;
  std::unique_ptr<Scene> scene;
  explicit Footprint() {
    kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .material = kit.black()});
    scene = kit.finish();
  }
  SurfaceInteraction hit(const RayDifferential& ray) const {
    std::uint64_t queries = 0;
    const auto h = scene->closest(ray, 0, {}, queries);
    SurfaceInteraction si = scene->surface(*h, ray);
    if (ray.hasDifferentials) si.computeDifferentials(ray);
    return si;
  }
  static RayDifferential camera(float dx, float dy) {
    RayDifferential ray(rayOf({0.2f, 0.1f, 4}, {-0.05f + dx, 0.03f + dy, -1}));
    return ray;
  }
  static RayDifferential cameraWithDifferentials(float step) {
    RayDifferential ray = camera(0, 0);
    ray.hasDifferentials = true;
    ray.rxOrigin = ray.ryOrigin = ray.o;
    ray.rxDirection = camera(step, 0).d;
    ray.ryDirection = camera(0, step).d;
    return ray;
  }
};

Vector3f bend(Vector3f wo, Normal3f n, float ratio) {
  const float c = dot(wo, n), t = std::sqrt(1 - ratio * ratio * (1 - c * c));
  return (ratio * c - t) * n - ratio * wo;
}

TEST(SpecularDifferentials, OfMirroredRaysMatchNeighbouringRays) {
  constexpr float kStep = 2e-3f;
  const Footprint scene;
  const RayDifferential ray = Footprint::cameraWithDifferentials(kStep);
  const auto mirrored = [](const SurfaceInteraction& si) { return -si.wo + 2 * dot(si.wo, si.n) * si.n; };
  const SurfaceInteraction si = scene.hit(ray);
  const RayDifferential next = mirroredRay(si, ray, mirrored(si));
  const SurfaceInteraction right = scene.hit(Footprint::camera(kStep, 0)),
                           below = scene.hit(Footprint::camera(0, kStep));
  const float scale = distance(mirrored(right), mirrored(si));
  EXPECT_LT(distance(next.rxDirection, mirrored(right)), 0.02f * scale);
  EXPECT_LT(distance(next.ryDirection, mirrored(below)), 0.02f * scale);
  EXPECT_LT(distance(next.rxOrigin, right.p), 0.02f * distance(right.p, si.p));
}

TEST(SpecularDifferentials, OfRefractedRaysMatchNeighbouringRays) {
  constexpr float kStep = 2e-3f, kEta = 1.5f;
  const Footprint scene;
  const RayDifferential ray = Footprint::cameraWithDifferentials(kStep);
  const auto refracted = [](const SurfaceInteraction& si) { return bend(si.wo, si.n, 1 / kEta); };
  const SurfaceInteraction si = scene.hit(ray);
  const RayDifferential next = refractedRay(si, ray, refracted(si), kEta);
  const SurfaceInteraction right = scene.hit(Footprint::camera(kStep, 0)),
                           below = scene.hit(Footprint::camera(0, kStep));
  const float scale = distance(refracted(right), refracted(si));
  EXPECT_LT(distance(next.rxDirection, refracted(right)), 0.03f * scale);
  EXPECT_LT(distance(next.ryDirection, refracted(below)), 0.03f * scale);
}

TEST(DirectLighting, FollowsBothLobesOfSmoothGlass) {
  SceneKit kit;
  const RgbTexture* white = kit.builder.own(std::make_unique<ConstantTexture<Rgb>>(Rgb(1)));
  const FloatTexture* eta = kit.builder.own(std::make_unique<ConstantTexture<float>>(1.5f));
  const FloatTexture* zero = kit.builder.own(std::make_unique<ConstantTexture<float>>(0.0f));
  const Material* glass = kit.builder.own(std::make_unique<GlassMaterial>(
      GlassParams{.kr = white, .kt = white, .eta = eta, .uRoughness = zero, .vRoughness = zero}));
  kit.builder.addPrimitive({.shape = kit.square(0, 10), .material = glass});
  kit.sky(1);
  const auto scene = kit.finish();
  // One interface under a white sky: reflected F and transmitted (1 - F) scaled by the squared index ratio.
  const double f = 0.04;
  EXPECT_NEAR(
      estimate(WhittedIntegrator(*scene, {.maxDepth = 2}), rayOf({0.1f, 0.2f, 1}, {0, 0, -1}), 1).red.mean(),
      f + (1 - f) / (1.5 * 1.5), 1e-5);
}

}  // namespace
}  // namespace pbrtmedia
