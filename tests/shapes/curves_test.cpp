// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shapes/shape_probe.h"

namespace pbrtmedia {
namespace {

using test::makeRay;
using test::Probe;

/// From (0, 0, 0) to (3, 0, 0) in steps even in the parameter.
const std::vector<Point3f> kStraight = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};

Curves::Params strand(CurveType type, const std::vector<Point3f>& points, float width0, float width1,
                      const std::vector<Normal3f>& normals = {}, int splitDepth = 3) {
  Curves::Params params;
  params.type = type;
  params.splitDepth = splitDepth;
  params.addStrand(points, 3, CurveBasis::Bezier, width0, width1, normals);
  return params;
}

/// Down the z axis onto (x, y).
Ray down(float x, float y) { return makeRay({x, y, 5}, {0, 0, -1}); }

void expectNear(Vector3f a, Vec3d b, double tolerance = 1e-6) {
  EXPECT_LT(length(Vec3d(a) - b), tolerance) << a << " and " << b;
}

TEST(Curves, FlatStrandFacesTheRayWithTheWidthItHasThere) {
  const Curves curve(strand(CurveType::Flat, kStraight, 0.4f, 0.1f), {});
  const Probe probe(curve);
  for (const float u : {0.05f, 0.3f, 0.5f, 0.98f}) {
    const float half = lerp(u, 0.4f, 0.1f) / 2;
    for (const float side : {-1.0f, 1.0f}) {
      EXPECT_FALSE(probe.hit(down(3 * u, side * 1.01f * half)));
      const auto hit = probe.hit(down(3 * u, side * 0.5f * half));
      ASSERT_TRUE(hit);
      EXPECT_FLOAT_EQ(hit->t, 5);
      EXPECT_NEAR(hit->uv.x, u, 1e-6);
      // The ray comes down: z of its space is -z, dp/du is x, and so v grows toward -y.
      EXPECT_NEAR(hit->uv.y, 0.5 - 0.25 * side, 1e-6);
      const SurfaceInteraction si = curve.interaction(*hit, down(3 * u, side * 0.5f * half));
      expectNear(si.p, {3 * u, side * 0.5f * half, 0});
      expectNear(si.wo, {0, 0, 1});
      expectNear(si.n, {0, 0, -1});
      expectNear(si.dpdu, {3, 0, 0});
      expectNear(si.dpdv, {0, -2 * half, 0});
      EXPECT_EQ(si.shading.n, si.n);
      EXPECT_EQ(si.dndu, Normal3f{});
    }
  }
  EXPECT_FALSE(probe.hit(down(-0.01f, 0))) << "the ends are cut across";
  EXPECT_FALSE(probe.hit(down(3.01f, 0)));
  // From the side it is as wide as from above.
  EXPECT_TRUE(probe.hit(makeRay({1.5f, 4, 0.1f}, {0, -1, 0})));
  EXPECT_FALSE(probe.hit(makeRay({1.5f, 4, 0.13f}, {0, -1, 0})));
}

TEST(Curves, RibbonIsSeenByTheCosineOfItsNormal) {
  const std::vector<Normal3f> normals = {{0, 0, 2}, {0, 3, 0}};  // turns by 90 degrees
  const Curves curve(strand(CurveType::Ribbon, kStraight, 0.4f, 0.4f, normals), {});
  const Probe probe(curve);
  for (const float u : {0.1f, 0.25f, 0.5f, 0.75f}) {
    const double angle = u * std::numbers::pi / 2;
    const auto half = static_cast<float>(0.2 * std::cos(angle));
    EXPECT_TRUE(probe.hit(down(3 * u, 0.99f * half)));
    EXPECT_FALSE(probe.hit(down(3 * u, 1.01f * half)));
    const auto si = probe.at(down(3 * u, 0.5f * half));
    ASSERT_TRUE(si);
    // N x dp/du, and the normal dp/du x that is N itself.
    expectNear(si->n, {0, std::sin(angle), std::cos(angle)});
    expectNear(si->dpdv, 2.0 * half * Vec3d{0, std::cos(angle), -std::sin(angle)});
  }
  const Curves even(strand(CurveType::Ribbon, kStraight, 0.4f, 0.4f, {{0, 0, 1}, {0, 0, 1}}), {});
  EXPECT_TRUE(Probe(even).hit(down(1, 0.19f)));
  EXPECT_FALSE(Probe(even).hit(makeRay({1, 4, 0.01f}, {0, -1, 0}))) << "it has no thickness";
}

TEST(Curves, CylinderTurnsItsNormalAcrossTheWidth) {
  const Curves curve(strand(CurveType::Cylinder, kStraight, 0.4f, 0.4f), {});
  const Probe probe(curve);
  for (const double v : {0.01, 0.25, 0.5, 0.8, 0.99}) {
    const auto si = probe.at(down(1, static_cast<float>(-0.4 * (v - 0.5))));
    ASSERT_TRUE(si);
    EXPECT_NEAR(si->uv.y, v, 1e-5);
    // v grows toward -y. Outward at both borders, onward along the ray in the middle.
    const double angle = radians(lerp(v, -90.0, 90.0));
    expectNear(si->n, {0, -std::sin(angle), -std::cos(angle)}, 1e-5);
    EXPECT_NEAR(length(si->dpdv), 0.4, 1e-6);
    EXPECT_NEAR(dot(si->dpdv, si->n), 0, 1e-6);
  }
}

TEST(Curves, OrientationIsThatOfQuadrics) {
  const auto normalOf = [](const ShapePlacement& placement) {
    const Curves curve(strand(CurveType::Ribbon, kStraight, 1, 1, {{0, 0, 1}, {0, 0, 1}}), placement);
    const auto si = Probe(curve).at(down(placement.worldFromObject.vector(Vector3f{1, 0, 0}).x, 0.1f));
    EXPECT_TRUE(si);
    return si ? si->n : Normal3f{};
  };
  const Transform mirror = Transform::scale(-1, 1, 1);
  expectNear(normalOf({Transform(), false}), {0, 0, 1});
  expectNear(normalOf({Transform(), true}), {0, 0, -1});
  expectNear(normalOf({mirror, false}), {0, 0, -1});
  expectNear(normalOf({mirror, true}), {0, 0, 1});
}

TEST(Curves, HitLiesAtItsDistanceUnderAnyScale) {
  for (const double scale : {0.01, 1.0, 30.0}) {
    const Curves curve(strand(CurveType::Flat, kStraight, 0.4f, 0.4f),
                       {Transform::scale(scale, scale, scale)});
    const auto s = static_cast<float>(scale);
    const Ray ray = makeRay({1.5f * s, 0.1f * s, 7}, {0, 0, -2});
    const auto hit = Probe(curve).hit(ray);
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->t, 3.5f);
    const SurfaceInteraction si = curve.interaction(*hit, ray);
    expectNear(si.p, {1.5 * scale, 0.1 * scale, 0}, 1e-5 * scale);
    EXPECT_NEAR(length(si.dpdv), 0.4 * scale, 1e-5 * scale);
    EXPECT_FALSE(Probe(curve).hit(makeRay({1.5f * s, 0.21f * s, 7}, {0, 0, -2})));
  }
}

/// A strand with bends and a change of width, and rays around it.
const std::vector<Point3f> kBent = {{0, 0, 0}, {2, 1, 0},     {-1, 2, 1},      {1, 3, 0.5f},
                                    {3, 4, 0}, {0.5f, 3, -1}, {0, 1.5f, -0.5f}};

/// What dense sampling of the spine says of a ray.
struct Sampled {
  /// Distance along the ray at which it passes the strand, with a foot on the spine and well within its
  /// width.
  double sure = std::numeric_limits<double>::infinity();
  bool isNear = false;  ///< some part of the strand is about as near as half its width
};

Sampled sampleSpine(const Curves::Params& params, const Ray& ray) {
  const Vec3d o(ray.o), d = normalize(Vec3d(ray.d));
  std::vector<double> along, ratio;
  for (const Curves::Segment& s : params.segments) {
    const CubicBezier c{{Vec3d(s.p[0]), Vec3d(s.p[1]), Vec3d(s.p[2]), Vec3d(s.p[3])}};
    for (int i = 0; i < 4000; ++i) {
      const double u = i / 4000.0, half = lerp(u, double{s.width0}, double{s.width1}) / 2;
      const Vec3d q = c.at(u) - o;
      along.push_back(dot(q, d));
      ratio.push_back(length(q - along.back() * d) / half);
    }
  }
  Sampled found;
  for (std::size_t i = 1; i + 1 < ratio.size(); ++i) {
    if (along[i] > -0.15 && ratio[i] <= 1.15) found.isNear = true;
    const bool isFoot = ratio[i] < ratio[i - 1] && ratio[i] <= ratio[i + 1];
    if (isFoot && along[i] > 0.15 && ratio[i] <= 0.85) found.sure = std::min(found.sure, along[i]);
  }
  return found;
}

TEST(Curves, RaysMeetThemWhereTheSpineIsNearWhateverThePieces) {
  const Curves::Params params = strand(CurveType::Flat, kBent, 0.3f, 0.1f);
  std::vector<std::unique_ptr<Curves>> curves;
  std::vector<std::unique_ptr<Probe>> probes;
  for (const int depth : {0, 1, 3, 6}) {
    Curves::Params p = params;
    p.splitDepth = depth;
    curves.push_back(std::make_unique<Curves>(std::move(p), ShapePlacement{}));
    EXPECT_EQ(curves.back()->primitiveCount(), 2u << depth);
    probes.push_back(std::make_unique<Probe>(*curves.back()));
  }
  Rng rng(1);
  int hits = 0, misses = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto coordinate = [&] { return 6 * rng.uniform() - 2; };
    const Point3f o{coordinate(), coordinate(), coordinate()};
    const Point3f to{coordinate() / 2, coordinate() / 2 + 1, coordinate() / 3 - 0.3f};
    const Ray ray = makeRay(o, normalize(to - o));
    const Sampled sampled = sampleSpine(params, ray);
    for (const auto& probe : probes) {
      const auto hit = probe->hit(ray);
      if (std::isfinite(sampled.sure)) {
        ASSERT_TRUE(hit) << i;
        EXPECT_LE(hit->t, sampled.sure + 0.15) << i;
        ++hits;
      } else if (!sampled.isNear) {
        EXPECT_FALSE(hit) << i;
        ++misses;
      }
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 1000);
}

TEST(Curves, RaysLeaveAStraightStrandForGood) {
  std::vector<Point3f> points;
  for (int i = 0; i <= 9; ++i) points.push_back({static_cast<float>(i), 0, 0});
  for (const CurveType type : {CurveType::Flat, CurveType::Cylinder}) {
    const Curves curve(strand(type, points, 0.3f, 0.1f), {});
    const Probe probe(curve);
    Rng rng(5);
    int again = 0;
    for (int i = 0; i < 3000; ++i) {
      const Ray ray = down(0.5f + 8 * rng.uniform(), 0.28f * (rng.uniform() - 0.5f));
      const auto hit = probe.hit(ray);
      if (!hit) continue;
      const Point3f p = curve.interaction(*hit, ray).p;
      const Ray leaving = makeRay(p, test::randomDirection(rng));
      EXPECT_FALSE(probe.hit(leaving, 0, Exclusions(hit->id))) << i;
      again += probe.hit(leaving) ? 1 : 0;
    }
    EXPECT_GT(again, 500) << "without leaving it out many meet it again";
  }
}

TEST(Curves, RaysThatLeaveAStrandMeetItWhereItComesBack) {
  // A hairpin: there along x, and back two units above.
  const std::vector<Point3f> hairpin = {{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {0, 0, 2}};
  const Curves curve(strand(CurveType::Flat, hairpin, 0.2f, 0.2f), {});
  const Probe probe(curve);
  const Ray up = makeRay({1, 0.05f, -3}, {0, 0, 1});
  const auto first = probe.hit(up);
  ASSERT_TRUE(first);
  const Ray on = makeRay(curve.interaction(*first, up).p, {0, 0, 1});
  const auto second = probe.hit(on, 0, Exclusions(first->id));
  ASSERT_TRUE(second);
  EXPECT_GT(second->t, 1);
  // Crossed along one line: two hits, then none.
  EXPECT_EQ(probe.all(up).size(), 2u);
}

TEST(Curves, StrandsOfOneShapeAreLeftOneByOne) {
  Curves::Params params = strand(CurveType::Flat, kStraight, 0.4f, 0.4f);
  Curves::Params above =
      strand(CurveType::Flat, {{0, 0, 0.1f}, {1, 0, 0.1f}, {2, 0, 0.1f}, {3, 0, 0.1f}}, 0.4f, 0.4f);
  params.append(above);
  const Curves curve(std::move(params), {});
  const Probe probe(curve);
  EXPECT_EQ(curve.primitiveCount(), 16u);
  EXPECT_FALSE(curve.continues(7, 8));
  EXPECT_TRUE(curve.continues(0, 7));
  const auto all = probe.all(makeRay({1.4f, 0.05f, -3}, {0, 0, 1}));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_NEAR(all[0].p.z, 0, 1e-6);
  EXPECT_NEAR(all[1].p.z, 0.1, 1e-6);
}

TEST(Curves, NoRootIsFoundTwiceWhereDistancesAreBelowTheNormalNumbers) {
  const float step = std::numeric_limits<float>::denorm_min();
  const Curves curve(strand(CurveType::Flat,
                            {{0, 0, 40 * step},
                             {100 * step, 0, 40 * step},
                             {200 * step, 0, 43 * step},
                             {300 * step, 0, 55 * step}},
                            step, 0, {}, 0),
                     {});
  int hits = 0, again = 0;
  for (int i = 0; i <= 300; ++i) {
    const Ray ray = makeRay({static_cast<float>(i) * step, 0, 0}, {0, 0, 1});
    const auto first = curve.intersect(0, ray, 0, HUGE_VAL, {});
    if (!first) continue;
    ++hits;
    const float start[] = {static_cast<float>(first->t)};
    again += curve.intersect(0, ray, 0, HUGE_VAL, start) ? 1 : 0;
  }
  EXPECT_GT(hits, 200);
  EXPECT_EQ(again, 0);
}

TEST(Curves, AreaIsThatOfTheSideThatIsSeen) {
  const Curves curve(strand(CurveType::Flat, kStraight, 0.4f, 0.2f), {Transform::scale(2, 2, 2)});
  double sum = 0;
  for (std::uint32_t i = 0; i < curve.primitiveCount(); ++i) sum += curve.area(i);
  EXPECT_NEAR(sum, 4 * 3 * 0.3, 1e-6);
  EXPECT_EQ(curve.sample(0, Point2f(0.5f, 0.5f)).pdf, 0);
  EXPECT_FALSE(curve.isClosed());
}

TEST(Curves, RejectsWhatMakesNoStrand) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto rejects = [](const std::vector<Point3f>& points, int degree, float width0, float width1,
                          const char* name, CurveType type = CurveType::Flat,
                          const std::vector<Normal3f>& normals = {}) {
    Curves::Params params;
    params.type = type;
    try {
      params.addStrand(points, degree, CurveBasis::Bezier, width0, width1, normals);
    } catch (const std::invalid_argument& e) {
      EXPECT_TRUE(std::string(e.what()).starts_with(name)) << e.what();
      return;
    }
    ADD_FAILURE() << "not rejected: " << name;
  };
  rejects({}, 3, 1, 1, "P:");
  rejects({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 3, 1, 1, "P:");
  rejects({{0, 0, 0}, {1, nan, 0}, {2, 0, 0}, {3, 0, 0}}, 3, 1, 1, "P:");
  rejects({{0, 0, 0}, {1, kInfinity, 0}, {2, 0, 0}, {3, 0, 0}}, 3, 1, 1, "P:");
  rejects(kStraight, 4, 1, 1, "degree:");
  rejects(kStraight, 3, nan, 1, "width0:");
  rejects(kStraight, 3, 1, -1, "width1:");
  rejects(kStraight, 3, 1, kInfinity, "width1:");
  rejects(kStraight, 3, 1, 1, "N:", CurveType::Ribbon, {{0, 0, 1}});
  rejects(kStraight, 3, 1, 1, "N:", CurveType::Ribbon, {{0, 0, 1}, {0, 0, 0}});
  rejects(kStraight, 3, 1, 1, "N:", CurveType::Ribbon, {{0, 0, 1}, {nan, 0, 1}});
}

TEST(Curves, SegmentsWithoutLengthOrWidthAreLeftOut) {
  const std::vector<Point3f> points = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0},
                                       {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(strand(CurveType::Flat, points, 0.1f, 0.1f).segments.size(), 1u);
  EXPECT_TRUE(strand(CurveType::Flat, kStraight, 0, 0).segments.empty());
  // Doubled end points have no tangent there; a hit has one all the same.
  const Curves curve(strand(CurveType::Flat, {{0, 0, 0}, {0, 0, 0}, {3, 0, 0}, {3, 0, 0}}, 0.2f, 0.2f), {});
  const auto si = Probe(curve).at(down(0, 0.05f));
  ASSERT_TRUE(si);
  EXPECT_TRUE(isFinite(si->n) && isFinite(si->dpdu) && isFinite(si->dpdv));
  // Nor has a cusp, where a strand goes out and comes back the same way.
  const Curves cusp(strand(CurveType::Flat, {{0, 0, 0}, {4, 0, 0}, {4, 0, 0}, {0, 0, 0}}, 0.2f, 0.2f), {});
  for (const float x : {2.9999f, 3.0f}) {
    const auto turn = Probe(cusp).at(down(x, 0.05f));
    EXPECT_TRUE(!turn || (isFinite(turn->n) && isFinite(turn->dpdv)));
  }
  RayHit tip{5, {PrimitiveId::kNone, 0, 3}, {0.5f, 0.4f}};
  EXPECT_TRUE(isFinite(cusp.interaction(tip, down(3, 0.01f)).n));
  // Along the strand itself: no hit, or a finite one.
  const auto along = Probe(curve).at(makeRay({-1, 0, 0}, {1, 0, 0}));
  EXPECT_TRUE(!along || (isFinite(along->n) && isFinite(along->dpdv)));
}

}  // namespace
}  // namespace pbrtmedia
