// SPDX-License-Identifier: BSD-2-Clause
#include "world/line_walk.h"

#include <gtest/gtest.h>

#include <chrono>

#include "base/interruption.h"
#include "base/stop_signal.h"
#include "support/scene_kit.h"

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

/// Whoever walks: the ways that connect the two ends of a path, shadow rays, probes below a surface.
TEST(LineWalk, IsLeftWhenPathsAreAbandoned) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(1, 1), .material = kit.black()});
  const auto scene = kit.finish();
  const auto walkForALongTime = [&] {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < end) allHits(*scene, rayOf({0.3f, 0.1f, 0}, {0, 0, 1}));
  };
  const StopSignal signal({.timeLimit = 0.02, .abandonsPaths = true});
  EXPECT_THROW(walkForALongTime(), Interrupted);
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

/// How many hits a walk from the camera at `o` along `d` delivers.
std::size_t hitsFromCamera(const Scene& scene, Point3f o, Vector3f d) {
  const Ray ray = rayOf(o, d);
  LineWalk walk = LineWalk::fromCamera(scene, ray);
  std::uint64_t queries = 0;
  std::size_t n = 0;
  while (walk.next(queries)) ++n;
  return n;
}

TEST(LineWalk, FromTheCameraLeavesOutSurfacesThatHoldIt) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 2), .material = kit.black()});
  kit.builder.addPrimitive({.shape = kit.sphere({1, 2, 2}, 3), .material = kit.black()});  // through 0
  const auto scene = kit.finish();
  EXPECT_EQ(hitsFromCamera(*scene, {0, 0, 0}, {0.1f, 0.2f, 1}), 1u) << "the far side of the sphere";
  EXPECT_EQ(hitsFromCamera(*scene, {0, 0, 0}, {-0.1f, -0.2f, -1}), 0u);
  EXPECT_EQ(hitsFromCamera(*scene, {0, 0, 1e-4f}, {0.1f, 0.2f, -1}), 2u) << "close is not through";
}

TEST(LineWalk, FromTheCameraKnowsRoundedSurfaces) {
  // Planes and spheres whose coordinates are rounded: the ray starts some float spacings before or behind.
  Rng rng(4);
  const auto random = [&] {
    return Vector3f(rng.uniform(), rng.uniform(), rng.uniform()) - Vector3f(0.5f, 0.5f, 0.5f);
  };
  for (int i = 0; i < 300; ++i) {
    const Point3f o = 20.0f * random();
    const Vector3f a = 4.0f * random(), b = 4.0f * random(), d = random();
    SceneKit kit;
    kit.builder.addPrimitive(
        {.shape = kit.quad(o - a - b, o + a - b, o + a + b, o - a + b), .material = kit.black()});
    const float radius = length(a);
    kit.builder.addPrimitive({.shape = kit.sphere(o + a, radius), .material = kit.black()});
    const auto scene = kit.finish();
    EXPECT_EQ(hitsFromCamera(*scene, o, d), dot(a, d) > 0 ? 1u : 0u) << i;
  }
}

TEST(LineWalk, FromTheCameraCountsBoundariesButNotEmittersThatHoldIt) {
  SceneKit emitters, boundaries;
  const Shape* emitter = emitters.square(0, 1);
  emitters.builder.addPrimitive({.shape = emitter, .areaLights = emitters.emitters(emitter, Rgb(1))});
  boundaries.builder.addPrimitive(
      {.shape = boundaries.square(0, 2), .media = {boundaries.fog("fog", Rgb(1), Rgb(0)), nullptr}});
  EXPECT_EQ(hitsFromCamera(*emitters.finish(), {0.1f, 0.2f, 0}, {0, 0.1f, 1}), 0u);
  EXPECT_EQ(hitsFromCamera(*boundaries.finish(), {0.1f, 0.2f, 0}, {0, 0.1f, 1}), 1u);
}

TEST(LineWalk, FromTheCameraSeesTheGroundOfALargeWorld) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 1e4f), .material = kit.black()});
  const auto scene = kit.finish();
  EXPECT_EQ(hitsFromCamera(*scene, {3, 2, 0.01f}, {1, 1, -1}), 1u) << "a centimetre above 20 kilometres";
}

TEST(LineWalk, MeetsMaterialsFirstHoweverItGrazesThem) {
  for (const float slope : {1.0f, 0.03f, 0.004f}) {
    SceneKit kit;
    const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
    kit.builder.addPrimitive({.shape = kit.square(0, 900), .media = {fog, nullptr}});
    kit.builder.addPrimitive(
        {.shape = kit.quad({-999, -800, 0}, {700, -990, 0}, {900, 888, 0}, {-500, 999, 0}),
         .material = kit.black()});
    const auto scene = kit.finish();
    Rng rng(9);
    for (int i = 0; i < 200; ++i) {
      const Ray ray = rayOf({rng.uniform(), rng.uniform(), 1}, {1, rng.uniform() - 0.5f, -slope});
      LineWalk walk(*scene, ray, Exclusions{});
      std::uint64_t queries = 0;
      const auto first = walk.next(queries);
      ASSERT_TRUE(first);
      ASSERT_NE(first->primitive->material, nullptr) << slope;
      const CoincidentSurfaces others = walk.coincidentWith(*first, scene->surface(*first, ray), queries);
      ASSERT_EQ(others.size(), 1u) << slope;
      EXPECT_EQ(others.begin()->hit.hit.id.geometry, 0u);
      EXPECT_FALSE(walk.next(queries));
    }
  }
}

TEST(LineWalk, TellsWhatCoincidesFromWhatIsOnlyNear) {
  // Seen from far away: what lies 0.001 behind a surface is another one, though t hardly tells.
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  const Material* black = kit.black();
  kit.builder.addPrimitive({.shape = kit.square(0, 1), .material = black});
  kit.builder.addPrimitive({.shape = kit.square(0, 1), .material = black, .media = {fog, nullptr}});
  kit.builder.addPrimitive({.shape = kit.square(0, 1), .media = {fog, nullptr}});
  kit.builder.addPrimitive({.shape = kit.square(0, 1), .media = {fog, fog}});
  kit.builder.addPrimitive({.shape = kit.square(-0.001f, 1), .media = {fog, nullptr}});
  const auto scene = kit.finish();
  const Ray ray = rayOf({0.3f, 0.1f, 1000}, {0, 0, -1});
  LineWalk walk(*scene, ray, Exclusions{});
  std::uint64_t queries = 0;
  const auto first = walk.next(queries);
  ASSERT_TRUE(first);
  const CoincidentSurfaces others = walk.coincidentWith(*first, scene->surface(*first, ray), queries);
  for (const CoincidentSurfaces::Entry& e : others) EXPECT_LT(e.hit.hit.id.geometry, 3u);
  EXPECT_EQ(others.size(), first->hit.id.geometry == 1 ? 1u : 2u);
  const Exclusions start = others.startingWith(first->hit.id);
  EXPECT_EQ(start.entries().size(), 1 + others.size());
}

/// A box of fog, and a line through a point of one of its edges, up to rounding.
struct EdgeKit {
  SceneKit kit;
  std::unique_ptr<const Scene> scene;
  Rng rng{20261129};
  EdgeKit() {
    const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
    kit.builder.addPrimitive({.shape = kit.box({-1, -1, -1}, {1, 1, 1}), .media = {fog, nullptr}});
    scene = kit.finish();
  }
  Point3f onEdge() {
    Point3f p{2 * rng.uniform() - 1, rng.uniform() < 0.5f ? -1.0f : 1.0f,
              rng.uniform() < 0.5f ? -1.0f : 1.0f};
    for (auto turns = static_cast<int>(3 * rng.uniform()); turns > 0; --turns) p = {p.y, p.z, p.x};
    return p;
  }
};

TEST(LineWalk, EntersAsOftenAsItLeavesThroughEdges) {
  EdgeKit own;
  for (int i = 0; i < 200000; ++i) {
    const Point3f p = own.onEdge();
    Point3f o;
    do {
      for (std::size_t a = 0; a < 3; ++a) o[a] = 10 * own.rng.uniform() - 5;
    } while (!(maxComponent(abs(o)) > 1.1f));
    const Ray ray = rayOf(o, normalize(p - o));
    int inside = 0;
    for (const SceneHit& hit : allHits(*own.scene, ray)) {
      inside += dot(own.scene->surface(hit, ray).n, ray.d) < 0 ? 1 : -1;
      ASSERT_TRUE(inside == 0 || inside == 1) << i << ": " << o << " to " << p;
    }
    ASSERT_EQ(inside, 0) << i << ": " << o << " to " << p;
  }
}

TEST(LineWalk, LeavesOnceThroughAnEdgeOfAFaceThatItGrazes) {
  // Two of some 1e8 lines that leave a box through one face and, an ulp beside the edge, hit the next.
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(1), Rgb(0));
  TriangleMesh::Params mesh;
  mesh.indices = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                  1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
  mesh.P = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
            {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const Shape* box = kit.builder.own(std::make_unique<TriangleMesh>(std::move(mesh), ShapePlacement{}));
  kit.builder.addPrimitive({.shape = box, .media = {fog, nullptr}});
  const auto scene = kit.finish();
  const Ray far = rayOf({-0.699058831f, -0.999986589f, 0.976712108f},
                        {-0.991513848f, -7.54967841e-05f, 0.13000083f}),
            near = rayOf({0.59614712f, -0.999491274f, 0.901616037f},
                         {-0.0354304612f, -0.0051690191f, 0.999358773f});
  EXPECT_EQ(allHits(*scene, far).size(), 1u);
  EXPECT_EQ(allHits(*scene, near).size(), 1u);
}

}  // namespace
}  // namespace pbrtmedia
