// SPDX-License-Identifier: BSD-2-Clause
#include "singlescattering/shared_explorers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cameras/perspective.h"
#include "media/grid_medium.h"
#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using namespace test;

/// Two boxes of smoke, one behind the other, and a ball of glassless black behind the left half.
struct Smoke {
  Smoke() {
    GridMediumParams grid;
    grid.name = "smoke";
    grid.sigmaA = Rgb(.1f);
    grid.sigmaS = Rgb(.9f, .5f, .2f);
    grid.grid.nx = grid.grid.ny = grid.grid.nz = 4;
    Rng rng(3);
    for (int i = 0; i < 64; ++i) grid.grid.density.push_back(rng.uniform());
    grid.grid.p0 = {-1, -1, -1};
    grid.grid.p1 = {1, 1, 4};
    smoke = kit.builder.own(makeGridMedium(grid, Transform()));
    kit.builder.addPrimitive({.shape = kit.box({-1, -1, -1}, {1, 1, 1}), .media = {smoke, nullptr}});
    kit.builder.addPrimitive({.shape = kit.box({-1, -1, 2}, {1, 1, 4}), .media = {smoke, nullptr}});
    kit.builder.addPrimitive({.shape = kit.sphere({-1.5f, 0, 1.5f}, 1), .material = kit.black()});
    scene = kit.finish();
    media.emplace(*scene, CameraMedium(*scene, {0, 0, -6}, 0, nullptr));
  }
  SharedExplorers explorers(std::uint64_t seed = 1) const { return {*media, camera, seed}; }

  SceneKit kit;
  const Medium* smoke = nullptr;
  std::unique_ptr<Scene> scene;
  std::optional<MediaTopology> media;
  PerspectiveCamera camera{AnimatedTransform(Transform::translate(Vec3d(0, 0, -6))),
                           {.fullResolution = {32, 32}, .screenWindow = screenWindowOfAspect(1), .fov = 20}};
};

bool same(std::span<const Explorer> a, std::span<const Explorer> b) {
  return std::ranges::equal(a, b, [](const Explorer& x, const Explorer& y) {
    return x.t == y.t && x.extinction == y.extinction && x.difference == y.difference;
  });
}

TEST(SharedExplorers, AreAFunctionOfSeedAndBlockWhateverTheOrder) {
  const Smoke smoke;
  SharedExplorers forward = smoke.explorers(), backward = smoke.explorers(), other = smoke.explorers(2);
  std::vector<std::vector<Explorer>> found;
  for (int i = 0; i < 32 * 32; ++i) {
    const auto of = forward.of({i % 32, i / 32});
    found.emplace_back(of.begin(), of.end());
  }
  for (int i = 32 * 32 - 1; i >= 0; --i)
    EXPECT_TRUE(same(backward.of({i % 32, i / 32}), found[static_cast<std::size_t>(i)])) << i;
  EXPECT_EQ(forward.lookups(), backward.lookups());
  EXPECT_FALSE(same(other.of({16, 16}), forward.of({16, 16})));
}

TEST(SharedExplorers, AreSharedByTheBlockAndCountedOnce) {
  const Smoke smoke;
  SharedExplorers explorers = smoke.explorers();
  const auto first = explorers.of({16, 16});
  ASSERT_FALSE(first.empty());
  const std::uint64_t lookups = explorers.lookups();
  EXPECT_GE(lookups, first.size());
  for (int y = 16; y < 20; ++y) {
    for (int x = 16; x < 20; ++x) EXPECT_EQ(explorers.of({x, y}).data(), first.data());
  }
  EXPECT_EQ(explorers.lookups(), lookups);
  EXPECT_FALSE(same(explorers.of({15, 16}), first));
  EXPECT_FALSE(same(explorers.of({-1, 16}), explorers.of({0, 16}))) << "pixels below 0 are other blocks";
}

TEST(SharedExplorers, LieOnTheStretchesOfTheMiddleRayAndKnowTheExtinctionThere) {
  const Smoke smoke;
  SharedExplorers explorers = smoke.explorers();
  const auto found = explorers.of({16, 16});
  const Ray ray = smoke.camera.generateRay({18, 18}, {.5f, .5f}, .5f).ray;
  EXPECT_TRUE(std::ranges::is_sorted(found, {}, &Explorer::t));
  std::size_t far = 0;
  const Medium* medium = smoke.smoke;
  RenderCounters counters;
  for (const Explorer& e : found) {
    const Point3f p(Vec3d(ray.o) + e.t * Vec3d(ray.d));
    EXPECT_TRUE((p.z >= -1.001f && p.z <= 1.001f) || (p.z >= 1.999f && p.z <= 4.001f)) << p.z;
    far += p.z > 1.5f;
    EXPECT_NEAR(e.extinction.r, medium->at(p, counters).sigmaT.r, 1e-4);
    EXPECT_GT(e.difference, 0);
    EXPECT_LT(e.difference, 1.01);
  }
  EXPECT_EQ(far, found.size() / 2) << "as many in the box behind";
  EXPECT_LT(explorers.of({4, 16}).size(), found.size()) << "the ball hides the box behind";
  EXPECT_TRUE(explorers.of({-40, 16}).empty()) << "beside the boxes";
}

TEST(ExplorersBetween, IncludesBothEnds) {
  const std::vector<Explorer> all = {{1, Rgb(1), 0}, {2, Rgb(1), 0}, {3, Rgb(1), 0}};
  EXPECT_EQ(explorersBetween(all, 1, 2).size(), 2u);
  EXPECT_EQ(explorersBetween(all, 1.5, 9).size(), 2u);
  EXPECT_TRUE(explorersBetween(all, 3.5, 9).empty());
  EXPECT_TRUE(explorersBetween({}, 0, 9).empty());
}

}  // namespace
}  // namespace pbrtmedia
