// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

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
  // The segment's middle (1, 0, 0) and three quarters of it (1, 1/2, 1/2), turned by a quarter.
  const Hyperboloid hyperboloid({.p1 = {1, -1, -1}, .p2 = {1, 1, 1}}, kPlain);
  expectHit(hyperboloid, {{0, 1, 0}, {0, 1, 0}, {0.25, 0.5}}, 0.05);
  expectHit(hyperboloid, {{-0.5, 1, 0.5}, {-1, 2, -1}, {0.25, 0.75}}, 0.05);
}

TEST(Hyperboloid, WithItsWaistElsewhereIsPbrtsSurface) {
  // The circles through p2 and p1 + 2 (p2 - p1) = (1, 2, 3) give r² = 13/8 + 3/8 z²; (u, v) and normals are
  // those of the segment's middle (1, 1/2, 0), turned by a quarter.
  const Hyperboloid::Params params{.p1 = {1, 0, -1}, .p2 = {1, 1, 1}};
  const Hyperboloid hyperboloid(params, kPlain);
  const double r = std::sqrt(1.625 / 1.25);
  expectHit(hyperboloid, {{-0.5 * r, r, 0}, {-1, 2, -0.5}, {0.25, 0.5}}, 0.05);
  const Hyperboloid::Waist waist = Hyperboloid::waist(params);
  EXPECT_TRUE(waist.isElsewhere);
  EXPECT_NEAR(waist.radius, std::sqrt(2), 1e-12);
  EXPECT_NEAR(waist.sweptRadius, 1, 1e-12);
  EXPECT_NEAR(hyperboloid.bounds().max.x, std::sqrt(2), 1e-6);
  EXPECT_FALSE(Hyperboloid::waist({.p1 = {1, -1, -1}, .p2 = {1, 1, 1}}).isElsewhere);
}

TEST(Hyperboloid, WhoseNormalsAreNotItsOwnStopsRaysOnTheirSide) {
  // At the point (-r/2, r, 0) of the test above the surface is vertical, but the normal leans down: what
  // leaves on its side and goes inward is stopped where it starts, and so is the opposite.
  const Hyperboloid hyperboloid({.p1 = {1, 0, -1}, .p2 = {1, 1, 1}}, kPlain);
  const Probe probe(hyperboloid);
  const float r = std::sqrt(1.625f / 1.25f);
  const Point3f p(-0.5f * r, r, 0);
  const Vector3f outward = normalize(Vector3f(-0.5f, 1, 0));
  const std::array start{0.0f};
  const auto stops = [&](Vector3f d) {
    const auto root = hyperboloid.intersect(0, makeRay(p, d), 0, kInfinity, start);
    return root && root->t == 0;
  };
  EXPECT_FALSE(stops(outward));
  EXPECT_FALSE(stops(-outward));
  EXPECT_TRUE(stops(Vector3f(0, 0, -1) - 0.1f * outward));
  EXPECT_TRUE(stops(Vector3f(0, 0, 1) + 0.1f * outward));
  EXPECT_FALSE(stops(Vector3f(0, 0, -1) + 0.1f * outward));
  EXPECT_FALSE(stops(Vector3f(0, 0, 1) - 0.1f * outward));
}

TEST(Hyperboloid, ThatIsASpheroidHasItsArea) {
  // p1 + 2 (p2 - p1) = (0, 1, 3): r² = (41 - z²) / 32.
  const Hyperboloid hyperboloid({.p1 = {2, 0, -1}, .p2 = {1, 0.5f, 1}}, kPlain);
  constexpr int kSteps = 100000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double z = lerp((i + 0.5) / kSteps, -1.0, 1.0);
    sum += std::sqrt((41 - z * z) / 32 + sqr(z / 32));
  }
  EXPECT_NEAR(hyperboloid.area(0), 2 * std::numbers::pi * sum * 2 / kSteps, 1e-8);
}

TEST(Hyperboloid, OfTwoSheetsHasTheAreaOfBothAndSamplesNothingElse) {
  // r² = A + B z² through (0.13, 1.5) and, at p1 + 2 (p2 - p1), (2.92, 5): nothing between -1.09 and 1.09.
  const Hyperboloid hyperboloid({.p1 = {2, 0, -2}, .p2 = {0.2f, 0.3f, 1.5f}}, kPlain);
  const double b = (2.92 - 0.13) / (25 - 2.25), a = 0.13 - b * 2.25, edge = std::sqrt(-a / b);
  const auto areaOf = [&](double z0, double z1) {
    constexpr int kSteps = 100000;
    double sum = 0;  // r sqrt(1 + r'²) = sqrt(A + (B + B²) z²)
    for (int i = 0; i < kSteps; ++i)
      sum += std::sqrt(a + (b + b * b) * sqr(lerp((i + 0.5) / kSteps, z0, z1)));
    return 2 * std::numbers::pi * sum * (z1 - z0) / kSteps;
  };
  const double lower = areaOf(-2, -edge), upper = areaOf(edge, 1.5);
  EXPECT_NEAR(hyperboloid.area(0), lower + upper, 1e-5);
  constexpr int kSamples = 1000;
  int above = 0;
  for (int i = 0; i < kSamples; ++i) {
    const ShapeSample s = hyperboloid.sample(0, Point2f((static_cast<float>(i) + 0.5f) / kSamples, 0.3f));
    EXPECT_NEAR(sqr(double{s.p.x}) + sqr(double{s.p.y}), a + b * sqr(double{s.p.z}), 1e-6);
    EXPECT_NEAR(s.pdf, 1 / (lower + upper), 1e-5);
    if (s.p.z > 0) ++above;
  }
  EXPECT_NEAR(above, kSamples * upper / (lower + upper), 1.5);
}

TEST(Hyperboloid, MayHaveNoSurfaceBetweenItsEnds) {
  EXPECT_TRUE(Hyperboloid::isEmpty({.p1 = {1, 0, -1}, .p2 = {0, 0, 1}}));  // r² = (z² - 1) / 8
  EXPECT_FALSE(Hyperboloid::isEmpty({.p1 = {1, 0, -1}, .p2 = {1, 1, 1}}));
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
  EXPECT_NE(message([] { Hyperboloid({.p1 = {1, 0, -1}, .p2 = {0, 0, 1}}, kPlain); }), "");
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
      // Those of the normal before orientation, as PBRT-v3 maps them: by the inverse transpose.
      const auto objectNormal = [&](const SurfaceInteraction& si) {
        const double sign = place.flipsNormal() ? -1 : 1;
        return sign * normalize(place.worldFromObject.inverse().normal(Vec3d(si.n)));
      };
      const auto checkNormal = [&](Normal3f found, const SurfaceInteraction& high,
                                   const SurfaceInteraction& low, const char* what) {
        const Vec3d expected =
            place.worldFromObject.normal((objectNormal(high) - objectNormal(low)) / (2 * h));
        expectNear(Vec3d(found), expected, 5e-3 * (1 + length(expected)), what);
      };
      checkNormal(c->dndu, *u1, *u0, "dndu");
      checkNormal(c->dndv, *v1, *v0, "dndv");
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
