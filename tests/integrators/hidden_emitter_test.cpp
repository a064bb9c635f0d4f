// SPDX-License-Identifier: BSD-2-Clause
// Emitters without material hide what of themselves is behind them, and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "base/warp.h"
#include "integrators/direct/direct_lighting.h"
#include "integrators/direct/whitted.h"
#include "materials/mirror.h"
#include "shapes/cylinder.h"
#include "shapes/disk.h"
#include "support/scene_kit.h"
#include "world/line_walk.h"

namespace pbrtmedia {
namespace {

using namespace test;
using Strategy = DirectLightingParams::Strategy;

struct EmitterCase {
  std::string name;
  std::function<const Shape*(SceneKit&)> shape;
  bool twoSided;
};

/// Above the floor, in no one's way.
std::vector<EmitterCase> emitterCases() {
  const Transform above = Transform::translate({0, 0, 2}) * Transform::rotate(70, {1, 0.3, 0});
  const auto sphere = [=](bool reverse, std::optional<float> zmax) {
    return [=](SceneKit& kit) {
      return kit.builder.own(std::make_unique<Sphere>(Sphere::Params{.radius = 0.8f, .zmax = zmax},
                                                      ShapePlacement{above, reverse}));
    };
  };
  const auto cylinder = [=](bool reverse) {
    return [=](SceneKit& kit) {
      return kit.builder.own(std::make_unique<Cylinder>(
          Cylinder::Params{.radius = 0.6f, .zmin = -1, .zmax = 1}, ShapePlacement{above, reverse}));
    };
  };
  const auto box = [=](SceneKit& kit) { return kit.box({-0.7f, -0.6f, -0.5f}, {0.5f, 0.6f, 0.7f}, above); };
  const auto disk = [=](SceneKit& kit) {
    return kit.builder.own(std::make_unique<Disk>(Disk::Params{}, ShapePlacement{above, true}));
  };
  return {{"sphere", sphere(false, {}), false},
          {"two-sided sphere", sphere(false, {}), true},
          {"sphere that emits inward", sphere(true, {}), false},
          {"two-sided cut sphere", sphere(false, 0.3f), true},
          {"cut sphere that emits inward", sphere(true, 0.3f), false},
          {"two-sided cylinder", cylinder(false), true},
          {"cylinder that emits inward", cylinder(true), false},
          {"box", box, false},
          {"two-sided box", box, true},
          {"two-sided disk", disk, true}};
}

/// A floor below the emitter; with `fog` the emitter is full of it.
std::unique_ptr<Scene> overFloor(const EmitterCase& emitter, bool hasMaterial, bool fog = false) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 20), .material = kit.matte(0.5f)});
  const Shape* shape = emitter.shape(kit);
  const MediumInterface inside{fog ? kit.fog("fog", Rgb(0.5f), Rgb(0.5f)) : nullptr, nullptr};
  kit.builder.addPrimitive({.shape = shape,
                            .material = hasMaterial ? kit.black() : nullptr,
                            .media = inside,
                            .areaLights = kit.emitters(shape, Rgb(3), emitter.twoSided)});
  return kit.finish();
}
const Ray kToFloor = rayOf({5, 0.1f, 4}, {-4, -0.3f, -4});  // meets it at (1, -0.2, 0)
constexpr Point3f kOnFloor{1, -0.2f, 0};

void expectSame(const Estimates& a, const Estimates& b, const std::string& what) {
  if (b.red.mean() == 0) {
    EXPECT_EQ(a.red.mean(), 0) << what;
    return;
  }
  const ZTest test = zTest(a.red, b.red);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << what << ": " << test;
}

/// By directions of the floor alone: what of the emitter is met first.
Estimates byHits(const Scene& scene, std::uint64_t n) {
  Estimates result;
  Rng rng(77);
  std::uint64_t queries = 0;
  for (std::uint64_t i = 0; i < n; ++i) {
    const float x = rng.uniform();
    const Ray ray = rayOf(kOnFloor, sampleCosineHemisphere({x, rng.uniform()}));
    LineWalk walk(scene, ray, Exclusions(PrimitiveId{PrimitiveId::kNone, 0, 0}));
    float value = 0;
    if (const auto hit = walk.next(queries)) {
      const SurfaceInteraction si = scene.surface(*hit, ray);
      value = 0.5f * hit->areaLight().emitted(si.n, si.wo).r;  // Kd / pi L cos / (cos / pi)
    }
    result.red.add(value);
  }
  return result;
}

class HiddenEmitter : public testing::TestWithParam<std::size_t> {};

/// With a black material the far side is hidden too, as by any surface.
TEST_P(HiddenEmitter, IlluminatesAsWithABlackMaterial) {
  const EmitterCase emitter = emitterCases()[GetParam()];
  const auto bare = overFloor(emitter, false), black = overFloor(emitter, true);
  constexpr std::uint64_t kN = 1 << 14;
  const Estimates truth = estimate(*makePath(*black, {.maxDepth = 1}), kToFloor, 1 << 16, 9);
  expectSame(estimate(*makePath(*bare, {.maxDepth = 1}), kToFloor, kN), truth, "path");
  expectSame(estimate(*makeVolPath(*bare, {.maxDepth = 1}), kToFloor, kN, 2), truth, "volpath");
  expectSame(estimate(WhittedIntegrator(*bare, {}), kToFloor, kN, 3), truth, "whitted: light samples alone");
  expectSame(estimate(DirectLightingIntegrator(*bare, {.strategy = Strategy::All}), kToFloor, kN, 4), truth,
             "directlighting, all");
  expectSame(estimate(DirectLightingIntegrator(*bare, {.strategy = Strategy::One}), kToFloor, kN, 5), truth,
             "directlighting, one");
  expectSame(byHits(*bare, 1 << 17), truth, "hits alone");
  const auto full = overFloor(emitter, false, /*fog=*/true);
  // What is before the fog is not dimmed by it; maxdepth 1 leaves no light for the fog to scatter.
  if (full->primitiveGroups()[0][1]->shape->isClosed()) {
    expectSame(estimate(*makeVolPath(*full, {.maxDepth = 1}), kToFloor, kN, 6), truth,
               "volpath, full of fog");
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, HiddenEmitter, testing::Range<std::size_t>(0, 10), [](const auto& value) {
  std::string name = emitterCases()[value.param].name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == '-'; }, '_');
  return name;
});

TEST(HiddenEmitters, DoNotHideEachOther) {
  // Two two-sided boxes, one behind the other as the floor sees them.
  const auto boxes = [](bool near, bool far) {
    SceneKit kit;
    kit.builder.addPrimitive({.shape = kit.square(0, 20), .material = kit.matte(0.5f)});
    const auto add = [&](const Shape* box) {
      kit.builder.addPrimitive({.shape = box, .areaLights = kit.emitters(box, Rgb(3), true)});
    };
    if (near) add(kit.box({-0.5f, -0.5f, 1}, {0.5f, 0.5f, 1.5f}));
    if (far) add(kit.box({-1, -1, 2}, {1, 1, 3}));
    return kit.finish();
  };
  const auto near = boxes(true, false), far = boxes(false, true), both = boxes(true, true);
  const auto check = [](const Estimates& a, const Estimates& b, const Estimates& sum, const char* what) {
    const double mean = sum.red.mean() - a.red.mean() - b.red.mean();
    const double error =
        std::hypot(sum.red.standardError(), std::hypot(a.red.standardError(), b.red.standardError()));
    EXPECT_LT(std::abs(mean), kMaxAbsZ * error) << what;
    EXPECT_LT(error, 0.015 * sum.red.mean()) << what;
  };
  const auto by = [](const auto& integrator) { return estimate(integrator, kToFloor, 1 << 15, 3); };
  check(by(*makePath(*near, {.maxDepth = 1})), by(*makePath(*far, {.maxDepth = 1})),
        by(*makePath(*both, {.maxDepth = 1})), "path");
  check(by(*makeVolPath(*near, {.maxDepth = 1})), by(*makeVolPath(*far, {.maxDepth = 1})),
        by(*makeVolPath(*both, {.maxDepth = 1})), "volpath");
  check(by(DirectLightingIntegrator(*near, {})), by(DirectLightingIntegrator(*far, {})),
        by(DirectLightingIntegrator(*both, {})), "directlighting");
  check(by(WhittedIntegrator(*near, {})), by(WhittedIntegrator(*far, {})), by(WhittedIntegrator(*both, {})),
        "whitted");
}

TEST(HiddenEmitters, DoNotHideOtherLights) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 20), .material = kit.matte(0.5f)});
  const Shape* lid = kit.quad({-9, -9, 1}, {9, -9, 1}, {9, 9, 1}, {-9, 9, 1});  // emits upward
  kit.builder.addPrimitive({.shape = lid, .areaLights = kit.emitters(lid, Rgb(3))});
  kit.pointLight({1, -0.2f, 2}, 4);
  const auto scene = kit.finish();
  const Ray below = rayOf({1.5f, -0.1625f, 0.5f}, {-4, -0.3f, -4});
  const double truth = 0.5 / std::numbers::pi * 4 / 4;
  for (const float value :
       {static_cast<float>(estimate(WhittedIntegrator(*scene, {}), below, 16).red.mean()),
        static_cast<float>(estimate(DirectLightingIntegrator(*scene, {}), below, 16).red.mean())})
    EXPECT_NEAR(value, truth, 1e-5);
  const ZTest path = zTest(estimate(*makePath(*scene, {.maxDepth = 1}), below, 4096).red, truth);
  EXPECT_LT(std::abs(path.z()), kMaxAbsZ) << path;
}

/// Cameras and mirrors see all layers in path and volpath, none in whitted and directlighting, as PBRT-v3's.
TEST(HiddenEmitters, AreSeenByPathAndVolpathOnly) {
  SceneKit kit;
  const RgbTexture* kr = kit.builder.own(std::make_unique<ConstantTexture<Rgb>>(Rgb(1)));
  const Material* mirror = kit.builder.own(std::make_unique<MirrorMaterial>(MirrorParams{.kr = kr}));
  kit.builder.addPrimitive({.shape = kit.square(-5, 20), .material = mirror});
  const Shape* box = kit.box({-1, -1, -1}, {1, 1, 1});
  kit.builder.addPrimitive({.shape = box, .areaLights = kit.emitters(box, Rgb(3), true)});
  const auto scene = kit.finish();
  const Ray direct = rayOf({0.2f, 0.3f, 9}, {0, 0, -1}), mirrored = rayOf({10.5f, 0.3f, 1}, {-1, 0, -1});
  for (const auto& [ray, seen] : {std::pair(direct, 12.0), std::pair(mirrored, 6.0)}) {
    EXPECT_NEAR(estimate(*makePath(*scene), ray, 4).red.mean(), seen, 1e-5);
    EXPECT_NEAR(estimate(*makeVolPath(*scene), ray, 4).red.mean(), seen, 1e-5);
    EXPECT_EQ(estimate(WhittedIntegrator(*scene, {}), ray, 4).red.mean(), 0);
    EXPECT_EQ(estimate(DirectLightingIntegrator(*scene, {}), ray, 4).red.mean(), 0);
  }
}

TEST(HiddenEmitters, InObjectsAreSeenAndHideNothing) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 20), .material = kit.matte(0.5f)});
  const Shape* box = kit.box({-1, -1, 2}, {1, 1, 3});
  const std::uint32_t object =
      kit.builder.addObject({{.shape = box, .areaLights = kit.emitters(box, Rgb(3), true)}});
  kit.builder.addInstance(object, AnimatedTransform(Transform()));
  kit.pointLight({1, -0.2f, 4}, 16);
  const auto scene = kit.finish();
  EXPECT_NEAR(estimate(*makePath(*scene, {.maxDepth = 1}), kToFloor, 16).red.mean(), 0.5 / std::numbers::pi,
              1e-5);
  // Both layers of the box, and the floor at (0, 0.09, 0) behind it.
  const double squared = 1 + 0.29 * 0.29 + 16,
               floor = 0.5 / std::numbers::pi * 16 / squared * 4 / std::sqrt(squared);
  EXPECT_NEAR(estimate(*makePath(*scene, {.maxDepth = 1}), rayOf({0, 0, 9}, {0, 0.01f, -1}), 16).red.mean(),
              6 + floor, 1e-4);
}

}  // namespace
}  // namespace pbrtmedia
