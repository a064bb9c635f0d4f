// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "shapes/shape_probe.h"

namespace pbrtmedia {
namespace {

using test::makeRay;
using test::Probe;

const ShapePlacement kPlain{};

void expectNear(Vec3d found, Vec3d expected, double tolerance, const char* what) {
  EXPECT_LE(length(found - expected), tolerance) << what << ": found " << found << ", expected " << expected;
}
template <class T>
void expectNear(Vec3<T> found, Vec3d expected, const char* what) {
  expectNear(Vec3d(found), expected, 1e-6 * (1 + length(expected)), what);
}

struct Expected {
  Vec3d p, n;
  Point2d uv;
};
/// A ray toward `e.p` from 3 units in front of it (along the normal or against it) hits there first.
void expectHit(const Shape& shape, const Expected& e, double from = 0.25) {
  const Probe probe(shape);
  const Vec3d n = normalize(e.n);
  const Ray ray = makeRay(Point3f(e.p + from * n), Vector3f(-n * (from > 0 ? 1.0 : -1.0)));
  const auto si = probe.at(ray);
  ASSERT_TRUE(si) << shape.typeName();
  expectNear(si->p, e.p, "p");
  expectNear(si->n, n, "n");
  EXPECT_NEAR(si->uv.x, e.uv.x, 1e-6) << shape.typeName();
  EXPECT_NEAR(si->uv.y, e.uv.y, 1e-6) << shape.typeName();
  EXPECT_EQ(shape.uvAt(*probe.hit(ray)), si->uv);
  expectNear(si->wo, -Vec3d(ray.d), "wo");
  EXPECT_EQ(si->shading.n, si->n);
}

TEST(Sphere, HasKnownPointsNormalsAndParameters) {
  const Sphere sphere({.radius = 2}, kPlain);
  EXPECT_TRUE(sphere.isClosed());
  EXPECT_EQ(sphere.typeName(), "sphere");
  expectHit(sphere, {{2, 0, 0}, {1, 0, 0}, {0, 0.5}});
  expectHit(sphere, {{0, 2, 0}, {0, 1, 0}, {0.25, 0.5}});
  expectHit(sphere, {{0, -2, 0}, {0, -1, 0}, {0.75, 0.5}});
  expectHit(sphere, {{std::sqrt(3.0), 0, 1}, {std::sqrt(3.0), 0, 1}, {0, 2.0 / 3}});  // polar angle 60 of 180
  expectHit(sphere, {{0, 0, 2}, {0, 0, 1}, {0, 1}});
  expectHit(sphere, {{0, 0, -2}, {0, 0, -1}, {0, 0}});
}

TEST(Sphere, HasKnownDerivatives) {
  const Sphere sphere({.radius = 2}, kPlain);
  const auto si = Probe(sphere).at(makeRay({5, 0, 0}, {-1, 0, 0}));
  ASSERT_TRUE(si);
  const double pi = std::numbers::pi;
  expectNear(si->dpdu, {0, 4 * pi, 0}, "dpdu");
  expectNear(si->dpdv, {0, 0, 2 * pi}, "dpdv");
  expectNear(si->dndu, {0, 2 * pi, 0}, "dndu");
  expectNear(si->dndv, {0, 0, pi}, "dndv");
}

TEST(Sphere, IsClippedByHeightAndSweep) {
  const Sphere sphere({.radius = 1, .zmin = -0.5f, .zmax = 0.5f, .phimax = 90}, kPlain);
  EXPECT_FALSE(sphere.isClosed());
  const Probe probe(sphere);
  expectHit(sphere, {{std::sqrt(0.5), std::sqrt(0.5), 0}, {1, 1, 0}, {0.5, 0.5}});
  EXPECT_FALSE(probe.hit(makeRay({0, 0, 0}, {0, 0, 1})));
  EXPECT_FALSE(probe.hit(makeRay({0, 0, 0}, {-1, 0.1f, 0})));
  EXPECT_FALSE(probe.hit(makeRay({0, 0, 0}, {1, -0.1f, 0})));
  EXPECT_TRUE(probe.hit(makeRay({-5, -5, 0}, {1, 1, 0})));  // from behind, through the missing part
  const double fourth = std::asin(0.5);                     // polar angle runs from 120 to 60 degrees
  expectHit(sphere, {{std::cos(fourth / 2), 0.001, std::sin(fourth / 2)},
                     {std::cos(fourth / 2), 0.001, std::sin(fourth / 2)},
                     {std::atan2(0.001, std::cos(fourth / 2)) / (std::numbers::pi / 2), 0.75}});
}

TEST(Cylinder, HasKnownPointsNormalsAndParameters) {
  const Cylinder cylinder({.radius = 1, .zmin = 3, .zmax = -1}, kPlain);
  expectHit(cylinder, {{1, 0, 0}, {1, 0, 0}, {0, 0.25}});
  expectHit(cylinder, {{-1, 0, 2}, {-1, 0, 0}, {0.5, 0.75}});
  const Probe probe(cylinder);
  EXPECT_FALSE(probe.hit(makeRay({0, 0, -5}, {0, 0, 1})));  // no caps
  EXPECT_FALSE(probe.hit(makeRay({5, 0, 3.001f}, {-1, 0, 0})));
  EXPECT_TRUE(probe.hit(makeRay({5, 0, 2.999f}, {-1, 0, 0})));
}

TEST(Cone, HasKnownPointsNormalsAndParameters) {
  const Cone cone({.radius = 1, .height = 2}, kPlain);
  expectHit(cone, {{0.5, 0, 1}, {2, 0, 1}, {0, 0.5}});
  expectHit(cone, {{0, -0.75, 0.5}, {0, -2, 1}, {0.75, 0.25}});
  const Probe probe(cone);
  EXPECT_FALSE(probe.hit(makeRay({5, 0, 2.5f}, {-1, 0, 0})));   // the mirrored half above the apex
  EXPECT_FALSE(probe.hit(makeRay({5, 0, -0.5f}, {-1, 0, 0})));  // below the base
}

TEST(Paraboloid, HasKnownPointsNormalsAndParameters) {
  const Paraboloid paraboloid({}, kPlain);
  expectHit(paraboloid, {{0.5, 0, 0.25}, {1, 0, -1}, {0, 0.25}});
  expectHit(paraboloid, {{0, 0, 0}, {0, 0, -1}, {0, 0}});
  const Paraboloid clipped({.radius = 1, .zmin = -1, .zmax = 1}, kPlain);
  expectHit(clipped, {{0.5, 0, 0.25}, {1, 0, -1}, {0, 0.625}});
}

TEST(Hyperboloid, HasKnownPointsNormalsAndParameters) {
  // The segment's middle (1, 1/2, 0), turned by a quarter.
  const Hyperboloid hyperboloid({.p1 = {1, 0, -1}, .p2 = {1, 1, 1}}, kPlain);
  expectHit(hyperboloid, {{-0.5, 1, 0}, {-1, 2, -0.5}, {0.25, 0.5}}, 0.05);
}

TEST(Hyperboloid, WithItsDefaultsIsACone) {
  const Hyperboloid hyperboloid({}, kPlain);
  expectHit(hyperboloid,
            {test::polar(std::sqrt(0.5), std::numbers::pi, 0.5), {-std::sqrt(0.5), 0, -1}, {0.375, 0.5}},
            0.05);
}

TEST(Disk, HasKnownPointsNormalsAndParameters) {
  const Disk disk({.height = 3, .radius = 2, .innerradius = 1}, kPlain);
  expectHit(disk, {{1.5, 0, 3}, {0, 0, 1}, {0, 0.5}});
  expectHit(disk, {{0, 1.25, 3}, {0, 0, 1}, {0.25, 0.75}});
  const Probe probe(disk);
  EXPECT_FALSE(probe.hit(makeRay({0.5f, 0, 5}, {0, 0, -1})));
  EXPECT_FALSE(probe.hit(makeRay({2.5f, 0, 5}, {0, 0, -1})));
  EXPECT_FALSE(probe.hit(makeRay({-5, 0, 3}, {1, 0, 0})));  // edge on
}

TEST(Quadrics, TurnTheirNormalsByReverseOrientationAndByMirrors) {
  const Transform mirror = Transform::scale(-1, 1, 1);
  const auto normalX = [](const ShapePlacement& placement) {
    const Sphere sphere({}, placement);
    return Probe(sphere).at(makeRay({5, 0, 0}, {-1, 0, 0}))->n.x;
  };
  EXPECT_EQ(normalX({Transform(), false}), 1);
  EXPECT_EQ(normalX({Transform(), true}), -1);
  EXPECT_EQ(normalX({mirror, false}), -1);  // scene-language reference 13.1: a mirrored sphere points inward
  EXPECT_EQ(normalX({mirror, true}), 1);
  const Disk disk({}, {mirror, false});
  EXPECT_EQ(Probe(disk).at(makeRay({0.5f, 0, 5}, {0, 0, -1}))->n.z, -1);
}

TEST(Quadrics, RejectParametersThatLeaveNothing) {
  const auto message = [](auto make) -> std::string {
    try {
      make();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(message([] { Sphere({.radius = -1}, kPlain); }),
            "radius: expected a finite number > 0, found -1");
  EXPECT_NE(message([] { Sphere({.radius = 1, .zmin = 2, .zmax = 3}, kPlain); }), "");
  EXPECT_NE(message([&] { Sphere({.radius = 1, .zmin = nan}, kPlain); }), "");
  EXPECT_NE(message([] { Sphere({.radius = 1, .phimax = 0}, kPlain); }), "");
  EXPECT_NE(message([] { Cylinder({.radius = 1, .zmin = 1, .zmax = 1}, kPlain); }), "");
  EXPECT_NE(message([&] { Cylinder({.radius = nan}, kPlain); }), "");
  EXPECT_NE(message([] { Disk({.radius = 1, .innerradius = 1}, kPlain); }), "");
  EXPECT_NE(message([] { Cone({.radius = 1, .height = 0}, kPlain); }), "");
  EXPECT_NE(message([] { Paraboloid({.radius = 1, .zmin = -2, .zmax = -1}, kPlain); }), "");
  EXPECT_NE(message([] { Hyperboloid({.p1 = {1, 0, 1}, .p2 = {0, 1, 1}}, kPlain); }), "");
  EXPECT_NE(message([] { Hyperboloid({.p1 = {0, 0, 0}, .p2 = {0, 0, 1}}, kPlain); }), "");
  EXPECT_EQ(message([] { Sphere({.radius = 1, .phimax = 720}, kPlain); }), "");  // clamped
}

/// Every kind of quadric in every placement.
template <class F>
void forEachPlacedQuadric(F f) {
  for (const auto& quadric : test::quadricCases()) {
    for (const auto& place : test::placements()) {
      SCOPED_TRACE(quadric.name + ", " + place.name);
      const auto shape = quadric.make(place.placement);
      f(quadric, place.placement, *shape);
    }
  }
}

TEST(Quadrics, FindThePointsOfTheirParametrisation) {
  forEachPlacedQuadric([](const auto& quadric, const ShapePlacement& place, const Shape& shape) {
    const Probe probe(shape);
    Rng rng(1);
    for (int i = 0; i < 300; ++i) {
      const double u = 0.01 + 0.98 * rng.uniformDouble(), v = 0.01 + 0.98 * rng.uniformDouble();
      const Vec3d target = place.worldFromObject.point(quadric.point(u, v));
      EXPECT_TRUE(shape.bounds().contains(Point3f(target)));
      const Vector3f d = test::randomDirection(rng);
      const auto hits = probe.all(makeRay(Point3f(target) - 3.0f * d, d));
      double best = 1e9;
      Point2f uv;
      for (const auto& si : hits) {
        if (const double miss = length(Vec3d(si.p) - target); miss < best) {
          best = miss;
          uv = si.uv;
        }
      }
      EXPECT_LT(best, 1e-3);  // grazing rays: the root moves by the square root of the rounding
      EXPECT_NEAR(uv.x, u, 2e-3);
      EXPECT_NEAR(uv.y, v, 2e-3);
    }
  });
}

TEST(Quadrics, HaveDerivativesThatPredictNeighbouringHits) {
  forEachPlacedQuadric([](const auto& quadric, const ShapePlacement& place, const Shape& shape) {
    const Probe probe(shape);
    Rng rng(2);
    const auto hitAt = [&](double u, double v) -> std::optional<SurfaceInteraction> {
      const Vec3d target = place.worldFromObject.point(quadric.point(u, v));
      // Along the normal, from close by: nothing else is between.
      const double h = 1e-4;
      const auto world = [&](double a, double b) { return place.worldFromObject.point(quadric.point(a, b)); };
      const Vec3d n = normalize(cross(world(u + h, v) - world(u - h, v), world(u, v + h) - world(u, v - h)));
      return probe.at(makeRay(Point3f(target + 0.01 * n), Vector3f(-n)));
    };
    for (int i = 0; i < 50; ++i) {
      const double u = 0.05 + 0.9 * rng.uniformDouble(), v = 0.05 + 0.9 * rng.uniformDouble(), h = 2e-3;
      const auto c = hitAt(u, v), u0 = hitAt(u - h, v), u1 = hitAt(u + h, v), v0 = hitAt(u, v - h),
                 v1 = hitAt(u, v + h);
      ASSERT_TRUE(c && u0 && u1 && v0 && v1);
      const auto check = [&](Vector3f found, Vector3f high, Vector3f low, const char* what) {
        const Vec3d expected = (Vec3d(high) - Vec3d(low)) / (2 * h);
        expectNear(Vec3d(found), expected, 5e-3 * (1 + length(expected)), what);
      };
      check(c->dpdu, u1->p, u0->p, "dpdu");
      check(c->dpdv, v1->p, v0->p, "dpdv");
      check(c->dndu, u1->n, u0->n, "dndu");
      check(c->dndv, v1->n, v0->n, "dndv");
      // dp/du x dp/dv in the object, negated by ReverseOrientation XOR mirror, seen in the world where a
      // mirror turns cross products once more.
      const double side = dot(Vec3d(c->n), cross(Vec3d(c->dpdu), Vec3d(c->dpdv)));
      EXPECT_GT(place.reverseOrientation ? -side : side, 0);
    }
  });
}

TEST(Quadrics, AgreeWithFineMeshesOnRandomRays) {
  constexpr int kRays = 2500;  // times 56 placed shapes: 1.4e5
  forEachPlacedQuadric([](const auto& quadric, const ShapePlacement& place, const Shape& shape) {
    const TriangleMesh mesh(test::tessellate(quadric, place.worldFromObject, 100), {});
    const Probe a(shape), b(mesh);
    const Bounds3f bounds = shape.bounds();
    const float size = length(bounds.diagonal());
    Rng rng(3);
    int disagreements = 0, hits = 0;
    for (int i = 0; i < kRays; ++i) {
      const Point3f target(lerp(rng.uniform(), bounds.min.x, bounds.max.x),
                           lerp(rng.uniform(), bounds.min.y, bounds.max.y),
                           lerp(rng.uniform(), bounds.min.z, bounds.max.z));
      const Vector3f d = test::randomDirection(rng);
      const Ray ray = makeRay(target - size * d, d);
      const auto ha = a.hit(ray), hb = b.hit(ray);
      EXPECT_EQ(a.accelerator().occluded(ray, 0, {}), ha.has_value());
      if (ha) ++hits;
      if (ha.has_value() != hb.has_value() || (ha && std::abs(ha->t - hb->t) > 0.02f * size)) ++disagreements;
    }
    EXPECT_GT(hits, kRays / 10);
    EXPECT_LT(disagreements, kRays / 50);  // rays within a facet's sagitta of an edge or silhouette
  });
}

}  // namespace
}  // namespace pbrtmedia
