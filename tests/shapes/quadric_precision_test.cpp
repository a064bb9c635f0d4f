// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "shapes/shape_probe.h"

namespace pbrtmedia {
namespace {

using test::makeRay;
using test::Probe;

/// Chords inside a closed shape, each starting on it in a direction uniform over the inner hemisphere (so
/// grazing ones are as frequent as any). Every one must hit exactly once: the far side. At cosines below
/// `rounding` (that of points and directions, as an angle) inside and outside are not told apart.
void expectNoLeaks(const Shape& shape, int chords, float rounding) {
  const auto& geometry = *std::get<const UserGeometry*>(shape.geometry());
  Rng rng(3);
  int misses = 0, extra = 0, outside = 0;
  const std::array<float, 1> atStart{0};
  for (int i = 0; i < chords; ++i) {
    const float a = rng.uniform(), b = rng.uniform(), c = rng.uniform(), e = rng.uniform();
    const ShapeSample s = shape.sample(0, {a, b});
    const Frame frame = Frame::fromZ(s.n);
    const Vector3f local = sampleUniformHemisphere({c, e});
    if (local.z < rounding) continue;
    const Ray in = makeRay(s.p, -frame.toWorld(local));
    const auto far = geometry.intersect(0, in, 0, kInfinity, atStart);
    if (!far) {
      ++misses;
      continue;
    }
    const std::array<float, 2> both{0, static_cast<float>(far->t)};
    if (geometry.intersect(0, in, far->t, kInfinity, both)) ++extra;
    if (geometry.intersect(0, makeRay(s.p, -in.d), 0, kInfinity, atStart)) ++outside;
  }
  EXPECT_EQ(misses, 0);
  EXPECT_EQ(extra, 0);
  EXPECT_EQ(outside, 0);
}

TEST(QuadricPrecision, NoneOfAMillionChordsLeavesASphere) { expectNoLeaks(Sphere({}, {}), 1000000, 1e-6f); }

TEST(QuadricPrecision, NoChordLeavesASphereFarFromTheOrigin) {
  expectNoLeaks(Sphere({.radius = 0.25f}, {Transform::translate({300, -200, 100}), false}), 300000, 2e-4f);
}

TEST(QuadricPrecision, NoChordLeavesAnEllipsoid) {
  expectNoLeaks(Sphere({}, {Transform::rotate(30, {1, 1, 0}) * Transform::scale(3, 0.5, 1), false}), 300000,
                1e-6f);
}

TEST(QuadricPrecision, PointsLieOnTheSurfaceHoweverFarTheOriginIs) {
  const Sphere sphere({.radius = 1e-3f}, {});
  const Probe probe(sphere);
  Rng rng(4);
  for (const float distance : {1.0f, 1e3f, 1e6f}) {
    for (int i = 0; i < 200; ++i) {
      const Vector3f d = test::randomDirection(rng);
      // Toward the centre up to the rounding of the far origin, so a hit is not certain from 1e6 away.
      const auto si = probe.at(makeRay(-distance * d, d));
      if (!si) continue;
      EXPECT_NEAR(length(Vec3d(si->p)), 1e-3f, 1e-10) << distance;
      EXPECT_NEAR(length(Vec3d(si->p) / 1e-3 - Vec3d(si->n)), 0, 1e-6) << distance;
    }
  }
  ASSERT_TRUE(probe.at(makeRay({-1e6f, 0, 0}, {1, 0, 0})));
  EXPECT_FLOAT_EQ(probe.at(makeRay({-1e6f, 0, 0}, {1, 0, 0}))->p.x, -1e-3f);
}

TEST(QuadricPrecision, EveryHitIsOnItsSurface) {
  for (const auto& quadric : test::quadricCases()) {
    SCOPED_TRACE(quadric.name);
    const auto shape = quadric.make({});
    const Probe probe(*shape);
    Rng rng(5);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vector3f d = test::randomDirection(rng);
      const Point3f target(rng.uniform(), rng.uniform() - 0.5f, rng.uniform());
      for (const auto& si : probe.all(makeRay(target - 50.0f * d, d))) {
        ++hits;
        // (u, v) and p are found in one go; each must lead to the other.
        EXPECT_LT(length(quadric.point(si.uv.x, si.uv.y) - Vec3d(si.p)), 3e-6);
        EXPECT_NEAR(length(Vec3d(si.n)), 1, 1e-6);
      }
    }
    EXPECT_GT(hits, 100);
  }
}

TEST(QuadricPrecision, ExclusionComesBeforeClipping) {
  // The near half is clipped away; the ray starts where it would have been. Nearest root: the clipped one.
  const Sphere bowl({.radius = 1, .zmin = -1, .zmax = 0}, {});
  const Probe probe(bowl);
  const Ray ray = makeRay({0, 0, 1}, {0, 0, -1});
  const auto hit = probe.hit(ray);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 2);
  EXPECT_TRUE(probe.hit(ray, 0, Exclusions(hit->id, 0.1f)));   // leaves out the clipped root at 0
  EXPECT_FALSE(probe.hit(ray, 0, Exclusions(hit->id, 1.9f)));  // leaves out the root at 2
}

TEST(QuadricPrecision, RaysLeaveOpenShapesToBothSides) {
  const Cylinder tube({.radius = 1, .zmin = -1, .zmax = 1}, {});
  const Probe probe(tube);
  const auto hit = probe.hit(makeRay({5, 0, 0}, {-1, 0, 0}));
  ASSERT_TRUE(hit);
  const Point3f p(1, 0, 0);
  EXPECT_FALSE(probe.hit(makeRay(p, {1, 0.1f, 0}), 0, Exclusions(hit->id)));
  const auto across = probe.hit(makeRay(p, {-1, 0, 0}), 0, Exclusions(hit->id));
  ASSERT_TRUE(across);
  EXPECT_FLOAT_EQ(across->t, 2);
  EXPECT_FALSE(probe.hit(makeRay(p, {-1, 0, 0.9f}), 0, Exclusions(hit->id)));  // out through the open end
}

TEST(QuadricPrecision, AShadowRayBetweenTwoPointsOfASphereIsFree) {
  const Sphere sphere({}, {Transform::translate({0.3, 7, -2}), false});
  const Probe probe(sphere);
  const PrimitiveId id{PrimitiveId::kNone, 0, 0};
  Rng rng(8);
  for (int i = 0; i < 100000; ++i) {
    const float a = rng.uniform(), b = rng.uniform(), c = rng.uniform(), d = rng.uniform();
    const Point3f p = sphere.sample(0, {a, b}).p, q = sphere.sample(0, {c, d}).p;
    Exclusions ends(id, 0);
    ends.add(id, 1);
    ASSERT_FALSE(probe.accelerator().occluded(makeRay(p, q - p, 1), 0, ends));
  }
}

}  // namespace
}  // namespace pbrtmedia
