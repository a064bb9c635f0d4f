// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/ambientocclusion/ambient_occlusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shapes/disk.h"
#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using namespace test;

constexpr double kOpen = std::numbers::pi;

/// A large floor at z = 0 and what else there is.
std::unique_ptr<Scene> floorUnder(const auto& add) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 1000), .material = kit.matte(0.5f)});
  add(kit);
  return kit.finish();
}
std::unique_ptr<Scene> openFloor() {
  return floorUnder([](SceneKit&) {});
}
/// A disk of radius 2 at height 1 above the origin.
std::unique_ptr<Scene> floorUnderDisk(bool hasMaterial) {
  return floorUnder([&](SceneKit& kit) {
    Disk::Params disk;
    disk.height = 1;
    disk.radius = 2;
    const Shape* shape = kit.builder.own(std::make_unique<Disk>(disk, ShapePlacement{}));
    kit.builder.addPrimitive({.shape = shape, .material = hasMaterial ? kit.black() : nullptr});
  });
}
const Ray kToOrigin = rayOf({.3f, .2f, .5f}, {-.3f, -.2f, -.5f});

TEST(AmbientOcclusion, AnOpenPlaneIsPiFromBothSides) {
  const auto scene = openFloor();
  const AmbientOcclusionIntegrator occlusion(*scene, {.samples = 16});
  for (const float side : {1.0f, -1.0f}) {
    const Estimates e = estimate(occlusion, rayOf({.1f, .2f, side}, {.3f, .1f, -side}), 32);
    for (std::size_t i = 0; i < 32; ++i) EXPECT_NEAR(e.values[i].g, kOpen, 1e-6);
    EXPECT_EQ(e.counters.shadowRays, 32u * 16);
  }
  EXPECT_EQ(estimate(occlusion, rayOf({0, 0, 1}, {0, 0, 1}), 4).red.mean(), 0) << "nothing is seen";
}

TEST(AmbientOcclusion, UniformDirectionsHaveTheSameMeanButVary) {
  const auto scene = openFloor();
  const Estimates e = estimate(AmbientOcclusionIntegrator(*scene, {.cosineSampling = false, .samples = 4}),
                               kToOrigin, 1 << 14);
  const ZTest test = zTest(e.red, kOpen, 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_GT(e.red.variance(), 0.01);
}

/// Directions within the cone of the disk are blocked: cos² of its half-angle, h² / (h² + r²), is left.
TEST(AmbientOcclusion, UnderADiskIsWhatItsConeLeaves) {
  const auto scene = floorUnderDisk(true);
  for (const bool cosine : {true, false}) {
    const ZTest test =
        zTest(estimate(AmbientOcclusionIntegrator(*scene, {.cosineSampling = cosine, .samples = 8}),
                       kToOrigin, 1 << 14)
                  .red,
              kOpen / 5, 1);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << cosine << test;
    const ZTest other =
        zTest(estimate(AmbientOcclusionIntegrator(*scene, {.cosineSampling = cosine, .samples = 8}),
                       kToOrigin, 1 << 14)
                  .red,
              kOpen / 5 * 1.05, 1);
    EXPECT_GT(std::abs(other.z()), kMaxAbsZ) << "5 % would be seen" << other;
  }
}

/// At distance d before a wall of height H that is wide without end: (1 - cos atan(H/d)) / 2 is blocked.
TEST(AmbientOcclusion, BeforeAWallLacksItsPart) {
  const auto scene = floorUnder([](SceneKit& kit) {
    kit.builder.addPrimitive({.shape = kit.quad({-3, -9000, 0}, {-3, 9000, 0}, {-3, 9000, 4}, {-3, -9000, 4}),
                              .material = kit.black()});
  });
  const ZTest test = zTest(
      estimate(AmbientOcclusionIntegrator(*scene, {.samples = 8}), kToOrigin, 1 << 14).red, kOpen * .8, 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST(AmbientOcclusion, SurfacesWithoutMaterialAreNotThere) {
  const auto scene = floorUnderDisk(false);
  const AmbientOcclusionIntegrator occlusion(*scene, {.samples = 4});
  EXPECT_NEAR(estimate(occlusion, kToOrigin, 64).red.mean(), kOpen, 1e-6) << "in the way of directions";
  EXPECT_NEAR(estimate(occlusion, rayOf({.5f, 0, 3}, {0, 0, -1}), 64).red.mean(), kOpen, 1e-6)
      << "of the view";
}

TEST(AmbientOcclusion, InsideOfASphereIsDark) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 2), .material = kit.matte(1)});
  const auto scene = kit.finish();
  EXPECT_EQ(estimate(AmbientOcclusionIntegrator(*scene, {}), rayOf({.1f, 0, 0}, {1, 2, 3}), 64).red.mean(),
            0);
}

}  // namespace
}  // namespace pbrtmedia
