// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "accelerators/accelerator.h"
#include "accelerators/meshes.h"

namespace pbrtmedia {
namespace {

using test::builtFrom;
using test::makeRay;
using test::Mesh;

Transform placement(int i) {
  return Transform::translate({1.5 * i, -0.4 * i, 0.3}) * Transform::rotate(35.0 * i, {1, 0.3, i - 1.0}) *
         Transform::scale(0.5 + 0.2 * i, 0.7, i % 2 ? -0.9 : 0.9);
}

/// Hits of `a` (through an instance) against hits of the transformed copy `b`: as often, at the same place.
/// A few rays at silhouettes may differ, because one of the two is rounded elsewhere.
void expectSameHits(const Accelerator& a, const Accelerator& b, std::uint32_t instance, float time) {
  Rng rng(7 + instance);
  int hits = 0, disagreements = 0;
  const Point3f centre = b.bounds().centre();
  for (int i = 0; i < 20000; ++i) {
    const Point3f origin = centre + test::randomPoint(rng, 3);
    const Vector3f toward = centre + test::randomPoint(rng, 1) - origin;
    const Ray ray = makeRay(origin, toward, kInfinity, time);
    const auto ha = a.intersect(ray, 0, {}), hb = b.intersect(ray, 0, {});
    EXPECT_EQ(a.occluded(ray, 0, {}), ha.has_value());
    if (ha.has_value() != hb.has_value() || (ha && ha->id.primitive != hb->id.primitive)) {
      ++disagreements;
      continue;
    }
    if (!ha) continue;
    ++hits;
    EXPECT_EQ(ha->id.instance, instance);
    EXPECT_EQ(ha->id.geometry, 0u);
    EXPECT_NEAR(ha->t, hb->t, 2e-5f);
    EXPECT_NEAR(ha->uv.x, hb->uv.x, 2e-3f);
    EXPECT_NEAR(ha->uv.y, hb->uv.y, 2e-3f);
  }
  EXPECT_GT(hits, 1000);
  EXPECT_LE(disagreements, 20);
}

TEST(Instances, StaticOnesEqualTransformedCopies) {
  const Mesh mesh = test::sphereMesh(2);
  const Accelerator object = builtFrom(mesh);
  for (int i = 0; i < 4; ++i) {
    Accelerator a;
    a.addInstance(object, AnimatedTransform(placement(i)));
    a.build();
    const Mesh copy = mesh.transformed(placement(i));
    const Accelerator b = builtFrom(copy);
    expectSameHits(a, b, 0, 0);
    EXPECT_TRUE(a.bounds().contains(b.bounds().min) && a.bounds().contains(b.bounds().max));
  }
}

TEST(Instances, OfAnySizeEqualTransformedCopies) {
  const Mesh mesh = test::sphereMesh(2);
  for (const double scale : {1e-12, 1e-7, 1e-5, 1e5}) {
    SCOPED_TRACE(scale);
    // The object is as much larger as the placement makes it smaller.
    const Mesh resized = mesh.transformed(Transform::scale(1 / scale, 1 / scale, 1 / scale));
    const Accelerator object = builtFrom(resized);
    Accelerator a;
    a.addInstance(object, AnimatedTransform(Transform::scale(scale, scale, scale)));
    a.build();
    expectSameHits(a, builtFrom(mesh), 0, 0);
    // What Embree cannot take meets nothing, in whichever space.
    for (const float far : {1e13f, 1e18f, 1e30f}) {
      EXPECT_FALSE(a.intersect(makeRay({far, far, 0}, {-1, 0, 0}), 0, {})) << scale << ' ' << far;
      EXPECT_FALSE(a.occluded(makeRay({0, far, 0}, {far, 0, 0}), 0, {})) << scale << ' ' << far;
    }
  }
}

TEST(Instances, AnimatedOnesEqualCopiesAtEveryTime) {
  const Mesh mesh = test::sphereMesh(2);
  const Accelerator object = builtFrom(mesh);
  const AnimatedTransform motion(Transform::translate({-1, 0, 0}) * Transform::scale(0.8, 0.5, 0.6), 0.25,
                                 Transform::translate({1, 1, 0}) * Transform::rotate(160, {0, 1, 1}), 1.5);
  Accelerator a;
  const Mesh other = mesh.transformed(Transform::translate({0, 0, 50}));
  EXPECT_EQ(a.addTriangles(other.buffers()), 0u);
  EXPECT_EQ(a.addInstance(object, motion), 1u);
  a.build();
  for (const float time : {0.0f, 0.25f, 0.3f, 0.87f, 1.2f, 1.5f, 9.0f}) {
    SCOPED_TRACE(time);
    const Mesh copy = mesh.transformed(motion.at(time));
    const Accelerator b = builtFrom(copy);
    expectSameHits(a, b, 1, time);
  }
}

TEST(Instances, AreToldApartByTheirNumbersAndExcludedOneByOne) {
  const Mesh mesh{{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const Accelerator object = builtFrom(mesh);
  for (const bool isAnimated : {false, true}) {
    SCOPED_TRACE(isAnimated);
    Accelerator a;
    for (int i = 0; i < 3; ++i) {
      const Transform t = Transform::translate({0, 0, 2.0 - i});
      a.addInstance(object, isAnimated ? AnimatedTransform(t, 0, t * Transform::rotate(90, {0, 0, 1}), 1)
                                       : AnimatedTransform(t));
    }
    a.build();
    const Ray ray = makeRay({0, 0, -1}, {0, 0, 1}, kInfinity, 0.5f);
    Exclusions exclusions;
    float t = 0;
    for (std::uint32_t expected : {2u, 1u, 0u}) {
      const auto hit = a.intersect(ray, t, exclusions);
      ASSERT_TRUE(hit);
      EXPECT_EQ(hit->id, (PrimitiveId{expected, 0, 0}));
      EXPECT_FLOAT_EQ(hit->t, 3.0f - static_cast<float>(expected));
      t = hit->t;
      exclusions.add(hit->id, t);
    }
    EXPECT_FALSE(a.intersect(ray, t, exclusions));
    EXPECT_FALSE(a.occluded(ray, 0, exclusions));
  }
}

TEST(Instances, CoincidentOnesAreAllFoundSmallestNumberFirst) {
  const Mesh mesh{{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const Accelerator object = builtFrom(mesh);
  const Transform still, turned = Transform::rotate(1, {0, 0, 1});
  Accelerator a;
  a.addTriangles(mesh.buffers());
  a.addInstance(object, AnimatedTransform(still, 0, turned, 1));
  a.addInstance(object, AnimatedTransform(still));
  a.addInstance(object, AnimatedTransform(still, 0, turned, 1));
  a.build();
  const Ray ray = makeRay({0.1f, 0.1f, -1}, {0.05f, 0, 1});
  Exclusions exclusions;
  for (const std::uint32_t expected : {1u, 2u, 3u, PrimitiveId::kNone}) {
    const auto hit = a.intersect(ray, exclusions.isEmpty() ? 0 : 1, exclusions);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->id.instance, expected);
    EXPECT_EQ(hit->t, 1);
    exclusions.add(hit->id, hit->t);
  }
  EXPECT_FALSE(a.intersect(ray, 1, exclusions));
}

TEST(Instances, OfNothingAreNeverHit) {
  Accelerator object;
  object.build();
  Accelerator a;
  EXPECT_EQ(a.addInstance(object, AnimatedTransform()), 0u);
  a.build();
  EXPECT_TRUE(a.isEmpty());
  EXPECT_FALSE(a.intersect(makeRay({0, 0, 0}, {0, 0, 1}), 0, {}));
}

TEST(Instances, RejectSingularTransforms) {
  const Mesh mesh = test::boxMesh();
  const Accelerator object = builtFrom(mesh);
  Accelerator a;
  EXPECT_THROW(a.addInstance(object, AnimatedTransform(Transform(Transform::scale(1, 1, 0).matrix()))),
               std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
