// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/line_walk.h"

#include <gtest/gtest.h>

#include "scene_kit.h"

namespace pbrtmedia {
namespace {

using test::rayOf;
using test::SceneKit;

std::vector<SceneHit> allHits(const Scene& scene, const Ray& ray) {
  std::vector<SceneHit> hits;
  LineWalk walk(scene, ray, Exclusions{});
  std::uint64_t queries = 0;
  while (const auto hit = walk.next(queries)) hits.push_back(*hit);
  return hits;
}

TEST(LineWalk, FindsEveryHitInOrder) {
  SceneKit kit;
  const Material* black = kit.black();
  for (const float z : {3.0f, 1.0f, 2.0f})
    kit.builder.addPrimitive({.shape = kit.square(z, 1), .material = black});
  const auto scene = kit.finish();
  const auto hits = allHits(*scene, rayOf({0.3f, 0.1f, 0}, {0, 0, 1}));
  ASSERT_EQ(hits.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FLOAT_EQ(hits[i].t(), static_cast<float>(i + 1));
}

TEST(LineWalk, FindsCoincidentSurfacesOnceEach) {
  SceneKit kit;
  const Material* black = kit.black();
  for (int i = 0; i < 10; ++i) kit.builder.addPrimitive({.shape = kit.square(1, 1), .material = black});
  const auto scene = kit.finish();
  const auto hits = allHits(*scene, rayOf({0.3f, 0.1f, 0}, {0.1f, 0.05f, 1}));
  ASSERT_EQ(hits.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(hits[i].hit.id == hits[j].hit.id);
  }
}

TEST(LineWalk, EndsWhenMoreSurfacesCoincideThanCanBeLeftOut) {
  SceneKit kit;
  const Material* black = kit.black();
  for (int i = 0; i < 40; ++i) kit.builder.addPrimitive({.shape = kit.square(1, 1), .material = black});
  kit.builder.addPrimitive({.shape = kit.square(2, 1), .material = black});
  const auto scene = kit.finish();
  const auto hits = allHits(*scene, rayOf({0.3f, 0.1f, 0}, {0, 0, 1}));
  EXPECT_GE(hits.size(), 16u);
  EXPECT_LE(hits.size(), 41u);
  EXPECT_FLOAT_EQ(hits.back().t(), 2);
}

TEST(LineWalk, PassesSurfacesThatChangeNothing) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  kit.builder.addPrimitive({.shape = kit.square(1, 1)});
  kit.builder.addPrimitive({.shape = kit.square(2, 1), .media = {fog, fog}});
  kit.builder.addPrimitive({.shape = kit.square(3, 1), .media = {fog, nullptr}});
  const auto scene = kit.finish();
  const auto hits = allHits(*scene, rayOf({0.3f, 0.1f, 0}, {0, 0, 1}));
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_FLOAT_EQ(hits[0].t(), 3);
}

TEST(LineWalk, CrossesASphereTwice) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 5}, 1), .material = kit.black()});
  const auto scene = kit.finish();
  const auto hits = allHits(*scene, rayOf({0.2f, 0.1f, 0}, {0, 0, 1}));
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_NEAR(hits[0].t(), 5 - std::sqrt(0.95), 1e-5);
  EXPECT_NEAR(hits[1].t(), 5 + std::sqrt(0.95), 1e-5);
}

TEST(LineWalk, MeetsMaterialsBeforeBoundariesThatCoincide) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  kit.builder.addPrimitive({.shape = kit.square(0, 1), .media = {fog, nullptr}});
  kit.builder.addPrimitive({.shape = kit.square(0, 1), .material = kit.black()});
  kit.builder.addPrimitive({.shape = kit.square(0, 1), .media = {nullptr, fog}});
  const auto scene = kit.finish();
  const auto hits = allHits(*scene, rayOf({0.3f, 0.1f, 1}, {0.1f, 0.2f, -1}));
  ASSERT_EQ(hits.size(), 3u);
  EXPECT_NE(hits[0].primitive->material, nullptr);
}

TEST(LineWalk, TakesFirstWhatFitsAmongCoincidentBoundaries) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  for (int i = 0; i < 4; ++i) kit.builder.addPrimitive({.shape = kit.square(0, 1), .media = {fog, nullptr}});
  kit.builder.addPrimitive({.shape = kit.square(-1, 1), .media = {fog, nullptr}});
  const auto scene = kit.finish();
  for (std::uint32_t wanted = 0; wanted < 4; ++wanted) {
    const Ray ray = rayOf({0.3f, 0.1f, 1}, {0.1f, 0.2f, -1});
    LineWalk walk(*scene, ray, Exclusions{});
    std::uint64_t queries = 0;
    const auto first = walk.next(queries, [&](const SceneHit& h) { return h.hit.id.geometry == wanted; });
    ASSERT_TRUE(first);
    EXPECT_EQ(first->hit.id.geometry, wanted);
    int rest = 0;
    while (walk.next(queries)) ++rest;
    EXPECT_EQ(rest, 4);
  }
}

}  // namespace
}  // namespace pbrtmedia
