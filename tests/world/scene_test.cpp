// SPDX-License-Identifier: BSD-2-Clause
#include "world/scene.h"

#include <gtest/gtest.h>

#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using namespace test;

/// 0 where u < 1/2, else 1/4.
class HalfMask final : public Texture<float> {
 public:
  float evaluate(const SurfaceInteraction& si) const override { return si.uv.x < 0.5f ? 0.0f : 0.25f; }
};
/// 0 where the world x is negative.
class WorldMask final : public Texture<float> {
 public:
  float evaluate(const SurfaceInteraction& si) const override { return si.p.x < 0 ? 0.0f : 1.0f; }
};

struct Query {
  explicit Query(const Scene& s) : scene(s) {}
  std::optional<SceneHit> closest(const Ray& ray) { return scene.closest(ray, 0, {}, queries); }
  bool occluded(const Ray& ray) { return scene.occluded(ray, 0, {}, queries); }
  const Scene& scene;
  std::uint64_t queries = 0;
};
Ray down(float x, float y) { return rayOf({x, y, 1}, {0, 0, -1}); }

TEST(Scene, WithoutAnythingAnswersMisses) {
  SceneBuilder builder;
  const auto scene = builder.finish();
  Query query(*scene);
  EXPECT_FALSE(query.closest(down(0, 0)));
  EXPECT_FALSE(query.occluded(down(0, 0)));
  EXPECT_TRUE(scene->bounds().isEmpty());
  EXPECT_EQ(query.queries, 2u);
}

TEST(Scene, CutsOutAlphaForAllRaysOnlyWhereItIsExactlyZero) {
  SceneKit kit;
  const FloatTexture* mask = kit.builder.own(std::make_unique<WorldMask>());
  kit.builder.addPrimitive({.shape = kit.square(0, 1), .material = kit.black(), .alpha = mask});
  const auto scene = kit.finish();
  Query query(*scene);
  EXPECT_FALSE(query.closest(down(-0.5f, 0.1f)));
  EXPECT_FALSE(query.occluded(down(-0.5f, 0.1f)));
  EXPECT_TRUE(query.closest(down(0.5f, 0.1f)));
  EXPECT_TRUE(query.occluded(down(0.5f, 0.1f)));
}

TEST(Scene, CutsOutShadowAlphaForOcclusionRaysOnly) {
  SceneKit kit;
  const FloatTexture* mask = kit.builder.own(std::make_unique<HalfMask>());
  kit.builder.addPrimitive(
      {.shape = kit.sphere({0, 0, -3}, 1), .material = kit.black(), .shadowAlpha = mask});
  const auto scene = kit.finish();
  EXPECT_TRUE(scene->hasShadowAlpha());
  Query query(*scene);
  for (const float x : {-0.5f, 0.5f}) {
    for (const float y : {-0.5f, 0.5f}) {
      EXPECT_TRUE(query.closest(down(x, y)));
      EXPECT_EQ(query.occluded(down(x, y)), y < 0) << x << ' ' << y;  // u < 1/2 is y > 0
    }
  }
}

TEST(Scene, DoesNotShadowWithSurfacesWithoutMaterial) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 1)});
  const auto scene = kit.finish();
  Query query(*scene);
  EXPECT_TRUE(query.closest(down(0.2f, 0.1f)));
  EXPECT_FALSE(query.occluded(down(0.2f, 0.1f)));
}

TEST(Scene, TransformsWhatIsSeenThroughInstances) {
  SceneKit kit;
  const auto object = kit.builder.addObject({{.shape = kit.square(0, 1), .material = kit.black()}});
  kit.builder.addInstance(object,
                          AnimatedTransform(Transform::translate({5, 0, -2}) * Transform::scale(2, 3, 1)));
  kit.builder.addInstance(object, AnimatedTransform(Transform::translate({-5, 0, -4})));
  const auto scene = kit.finish();
  Query query(*scene);
  const auto hit = query.closest(down(6.5f, 2.5f));
  ASSERT_TRUE(hit);
  EXPECT_FLOAT_EQ(hit->t(), 3);
  ASSERT_NE(hit->placement, nullptr);
  const SurfaceInteraction si = scene->surface(*hit, down(6.5f, 2.5f));
  EXPECT_LT(distance(si.p, Point3f(6.5f, 2.5f, -2)), 1e-5f);
  EXPECT_LT(distance(si.n, Normal3f(0, 0, 1)), 1e-6f);
  EXPECT_LT(distance(si.wo, Vector3f(0, 0, 1)), 1e-6f);
  EXPECT_EQ(si.primitive, hit->hit.id);
  EXPECT_FALSE(query.closest(down(0, 0)));
  const auto other = query.closest(down(-5, 0.5f));
  ASSERT_TRUE(other);
  EXPECT_FLOAT_EQ(other->t(), 5);
}

TEST(Scene, FollowsAnimatedInstancesAtTheTimeOfTheRay) {
  SceneKit kit;
  const auto object = kit.builder.addObject({{.shape = kit.square(0, 1), .material = kit.black()}});
  kit.builder.addInstance(object, AnimatedTransform(Transform(), 0, Transform::translate({10, 0, 0}), 1));
  const auto scene = kit.finish();
  Query query(*scene);
  Ray ray = down(5.2f, 0.1f);
  EXPECT_FALSE(query.closest(ray));
  ray.time = 0.5f;
  const auto hit = query.closest(ray);
  ASSERT_TRUE(hit);
  EXPECT_LT(distance(scene->surface(*hit, ray).p, Point3f(5.2f, 0.1f, 0)), 1e-5f);
  const Segment inObject = hit->placement->toObject({ray.o, ray.d, 0, 1}, 0.5f);
  EXPECT_LT(distance(inObject.o, Point3f(0.2f, 0.1f, 1)), 1e-5f);
}

TEST(Scene, NumbersLightsInOrderOfAdditionAndEmittersPerTriangle) {
  SceneKit kit;
  kit.pointLight({0, 0, 3}, 1);
  const Shape* lamp = kit.square(0, 1);
  kit.builder.addPrimitive(
      {.shape = lamp, .material = kit.black(), .areaLights = kit.emitters(lamp, Rgb(2))});
  kit.sky(1);
  const auto scene = kit.finish();
  ASSERT_EQ(scene->lights().size(), 4u);
  ASSERT_EQ(scene->infiniteLights().size(), 1u);
  EXPECT_EQ(scene->infiniteLights()[0], 3u);
  Query query(*scene);
  const auto a = query.closest(down(0.5f, -0.3f)), b = query.closest(down(-0.5f, 0.3f));
  ASSERT_TRUE(a && b);
  EXPECT_NE(a->light, b->light);
  for (const auto& hit : {*a, *b}) {
    EXPECT_TRUE(hit.isEmitter());
    EXPECT_EQ(scene->lights()[hit.light], &hit.areaLight());
    EXPECT_EQ(scene->lightTarget(hit.light), hit.hit.id);
  }
  EXPECT_FALSE(scene->lightTarget(0).isValid());
}

TEST(Scene, PlacesNothingForAnEmptyObject) {
  SceneBuilder builder;
  builder.addInstance(builder.addObject({}), AnimatedTransform());
  const auto scene = builder.finish();
  EXPECT_TRUE(scene->bounds().isEmpty());
}

TEST(Scene, KnowsWhichMediumOutsideAnInstanceIsItsOwn) {
  SceneKit kit;
  const Medium* shell = kit.fog("shell", Rgb(1), Rgb(0));
  const Medium* core = kit.fog("core", Rgb(1), Rgb(0));
  const Medium* air = kit.fog("air", Rgb(1), Rgb(0));
  const auto object = kit.builder.addObject({{.shape = kit.sphere({0, 0, 0}, 2), .media = {shell, air}},
                                             {.shape = kit.sphere({0, 0, 0}, 1), .media = {core, shell}}});
  kit.builder.addInstance(object, AnimatedTransform());
  const auto scene = kit.finish();
  std::uint64_t queries = 0;
  const Ray toShell = rayOf({0, 0, 5}, {0, 0, -1}), toCore = rayOf({0, 0, 1.5f}, {0, 0, -1});
  EXPECT_EQ(scene->closest(toShell, 0, {}, queries)->outsidePlacement, nullptr);
  EXPECT_NE(scene->closest(toCore, 0, {}, queries)->outsidePlacement, nullptr);
}

}  // namespace
}  // namespace pbrtmedia
