// SPDX-License-Identifier: BSD-2-Clause
#include "lights/diffuse_area.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lights/light_test_support.h"
#include "shapes/cone.h"
#include "shapes/cylinder.h"
#include "shapes/disk.h"
#include "shapes/shape_probe.h"
#include "shapes/sphere.h"
#include "shapes/triangle_mesh.h"

namespace pbrtmedia {
namespace {

using test::expectRgb;
using test::kMaxAbsZ;
using test::zTest;

/// A disk of radius 1 at height 2 that faces down.
const Disk& ceiling() {
  static const Disk disk({.height = 2}, {.worldFromObject = Transform(), .reverseOrientation = true});
  return disk;
}

TriangleMesh oneTriangle() {
  TriangleMesh::Params params;
  params.indices = {0, 1, 2};
  params.P = {{-1, -1, 2}, {0.5f, 2, 2.5f}, {2, -0.5f, 1.5f}};
  return {params, {.worldFromObject = Transform()}};
}

TEST(DiffuseAreaLight, IrradianceUnderADiskIsPiTimesSineSquared) {
  // On the axis at distance h of a parallel disk of radius R: E = π L R² / (R² + h²) = 3π/5.
  const DiffuseAreaLight light(ceiling(), 0, {.radiance = Rgb(3)});
  const test::ZTest z =
      zTest(test::irradianceByLight(light, {0, 0, 0}, {0, 0, 1}, 1, 200000), 3 * std::numbers::pi / 5);
  EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
}

TEST(DiffuseAreaLight, IrradianceOfASphereIsPiTimesSineSquared) {
  // A sphere of radius R whose centre lies at distance d on the normal: E = π L (R/d)², here π/9.
  const Sphere sphere(Sphere::Params{}, {.worldFromObject = Transform::translate({0, 3, 0})});
  const DiffuseAreaLight light(sphere, 0, {});
  const test::ZTest z =
      zTest(test::irradianceByLight(light, {0, 0, 0}, {0, 1, 0}, 2, 100000), std::numbers::pi / 9);
  EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
}

TEST(DiffuseAreaLight, IrradianceOfATriangleIsLambertsFormula) {
  // E = L/2 Σ Θ_i (n · Γ_i) over the edges, Θ the angle an edge subtends and Γ its unit normal (Lambert
  // 1760).
  const TriangleMesh mesh = oneTriangle();
  const auto corners = mesh.corners(0);
  const Point3f p{0.1f, 0.2f, -0.3f};
  double truth = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d a = normalize(Vec3d(corners[i]) - Vec3d(p));
    const Vec3d b = normalize(Vec3d(corners[(i + 1) % 3]) - Vec3d(p));
    truth += 0.5 * std::acos(dot(a, b)) * normalize(cross(a, b)).z;
  }
  const DiffuseAreaLight light(mesh, 0, {.twoSided = true});
  const test::ZTest z = zTest(test::irradianceByLight(light, p, {0, 0, 1}, 3, 200000), std::abs(truth));
  EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
}

TEST(DiffuseAreaLight, EmitsOnTheSideOfTheNormalOnly) {
  const DiffuseAreaLight light(ceiling(), 0, {.radiance = {1, 2, 3}});
  EXPECT_EQ(light.emitted({0, 0, -1}, {0, 0.6f, -0.8f}), (Rgb{1, 2, 3}));
  EXPECT_TRUE(light.emitted({0, 0, -1}, {0, 0.6f, 0.8f}).isBlack());
  EXPECT_TRUE(light.emitted({0, 0, -1}, {1, 0, 0}).isBlack()) << "along the surface";
  EXPECT_EQ(light.sample({0, 0, 0}, {0.3f, 0.6f}).radiance, (Rgb{1, 2, 3})) << "the disk faces down";
  EXPECT_TRUE(light.sample({0, 0, 5}, {0.3f, 0.6f}).radiance.isBlack());
}

TEST(DiffuseAreaLight, EmitsOnBothSidesWhenTwoSided) {
  const DiffuseAreaLight light(ceiling(), 0, {.radiance = {1, 2, 3}, .twoSided = true});
  EXPECT_EQ(light.emitted({0, 0, -1}, {0, 0, 1}), (Rgb{1, 2, 3}));
  EXPECT_EQ(light.sample({0, 0, 5}, {0.3f, 0.6f}).radiance, (Rgb{1, 2, 3}));
  EXPECT_EQ(light.sample({0, 0, 0}, {0.3f, 0.6f}).radiance, (Rgb{1, 2, 3}));
}

TEST(DiffuseAreaLight, SamplesEndOnTheShape) {
  const DiffuseAreaLight light(ceiling(), 0, {});
  const Point3f reference{4, -2, 0.5f};
  Rng rng(4);
  for (int i = 0; i < 200; ++i) {
    const LightSample s = light.sample(reference, {rng.uniform(), rng.uniform()});
    ASSERT_GT(s.pdf, 0);
    const Point3f p = reference + s.distance * s.wi;
    EXPECT_NEAR(p.z, 2, 2e-6f);
    EXPECT_LE(std::hypot(p.x, p.y), 1 + 2e-6f);
  }
}

TEST(DiffuseAreaLight, PdfOfAHitEqualsThatOfTheSample) {
  const Sphere sphere(Sphere::Params{}, {.worldFromObject = Transform::translate({0, 3, 0})});
  const TriangleMesh mesh = oneTriangle();
  const Point3f reference{0.5f, -0.25f, 0.1f};
  for (const Shape* shape : {static_cast<const Shape*>(&sphere), static_cast<const Shape*>(&mesh),
                             static_cast<const Shape*>(&ceiling())}) {
    const DiffuseAreaLight light(*shape, 0, {});
    Rng rng(6);
    for (int i = 0; i < 200; ++i) {
      const Point2f u{rng.uniform(), rng.uniform()};
      const LightSample s = light.sample(reference, u);
      const ShapeSample onShape = shape->sample(0, reference, u);
      SurfaceInteraction hit;
      hit.p = onShape.p;
      hit.n = onShape.n;
      EXPECT_NEAR(light.pdf(reference, s.wi, &hit), s.pdf, 1e-3f * s.pdf) << shape->typeName();
    }
    EXPECT_EQ(light.pdf(reference, {0, 0, 1}, nullptr), 0) << "nothing of this light was hit";
  }
}

/// Which side of a shape emits as light samples find it, and as hits do: +1 that of `outward`, -1 the other.
struct Sides {
  int sampled, seen;
  bool operator==(const Sides&) const = default;
};
std::ostream& operator<<(std::ostream& os, const Sides& s) {
  return os << "sampled " << s.sampled << ", seen " << s.seen;
}

/// `p`: a point of the surface with the unit vector `outward` across it, of a shape that is alone there.
Sides sidesOf(const Shape& shape, Point3f p, Vector3f outward) {
  const DiffuseAreaLight light(shape, 0, {});
  const test::Probe probe(shape);
  Sides sides{0, 0};
  for (const int side : {1, -1}) {
    const Point3f from = p + static_cast<float>(side) * 0.5f * outward;
    const auto hit = probe.at(test::makeRay(from, static_cast<float>(-side) * outward));
    if (!hit) throw std::logic_error("the test ray must hit");
    if (!light.emitted(hit->n, hit->wo).isBlack()) sides.seen += side;
    // Of the samples those around the point, not those across an open shape.
    Rng rng(5);
    int lit = 0, dark = 0;
    for (int i = 0; i < 20000; ++i) {
      const LightSample s = light.sample(from, {rng.uniform(), rng.uniform()});
      if (!(s.pdf > 0) || dot(s.wi, static_cast<float>(-side) * outward) < 0.9f || s.distance > 0.6f)
        continue;
      ++(s.radiance.isBlack() ? dark : lit);
    }
    if (lit > 0 && dark > 0) throw std::logic_error("some samples of one side emit");
    if (lit > 0) sides.sampled += side;
  }
  return sides;
}

TEST(DiffuseAreaLight, OfMirroredQuadricsIsSampledAsWithoutTheMirror) {
  for (const bool mirrored : {false, true}) {
    for (const bool reversed : {false, true}) {
      const ShapePlacement place{mirrored ? Transform::scale(1, -1, 1) : Transform(), reversed};
      const int lit = reversed ? -1 : 1, seen = reversed != mirrored ? -1 : 1;
      const Sides expected{lit, seen};
      const std::string what = std::string(mirrored ? "mirrored " : "") + (reversed ? "reversed " : "");
      EXPECT_EQ(sidesOf(Sphere(Sphere::Params{}, place), {1, 0, 0}, {1, 0, 0}), expected) << what << "sphere";
      EXPECT_EQ(sidesOf(Cylinder({}, place), {1, 0, 0}, {1, 0, 0}), expected) << what << "cylinder";
      EXPECT_EQ(sidesOf(Disk({}, place), {0.5f, 0, 0}, {0, 0, 1}), expected) << what << "disk";
      EXPECT_EQ(sidesOf(Cone({}, place), {0.5f, 0, 0.5f}, normalize(Vector3f(1, 0, 1))), expected)
          << what << "cone";
    }
  }
}

TEST(DiffuseAreaLight, OfMeshesWithNormalsIsSampledOnTheirSideReversedOrNot) {
  const Normal3f up(0, 0, 1);
  for (const bool mirrored : {false, true}) {
    for (const bool reversed : {false, true}) {
      const ShapePlacement place{mirrored ? Transform::scale(1, -1, 1) : Transform(), reversed};
      TriangleMesh::Params params;
      params.indices = {0, 1, 2};
      params.P = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
      const int turned = reversed ? -1 : 1;
      const auto sides = [&] { return sidesOf(TriangleMesh(params, place), {0, 0, 0}, up); };
      EXPECT_EQ(sides(), (Sides{turned, turned})) << "neither N nor S";
      params.S.assign(3, {1, 0, 0});
      EXPECT_EQ(sides(), (Sides{turned, 1})) << "S: seen as if not reversed";
      params.N.assign(3, up);
      EXPECT_EQ(sides(), (Sides{1, turned})) << "N: sampled as if not reversed";
    }
  }
}

TEST(DiffuseAreaLight, KnowsTheAreaThatPbrtSamplesInItsPlace) {
  const ShapePlacement half{Transform::scale(0.5, 0.5, 0.5), false};
  const double pi = std::numbers::pi;
  EXPECT_NEAR(Sphere({.radius = 2, .zmax = 0}, half).areaSampledByPbrt(0), 16 * pi, 1e-12);
  EXPECT_NEAR(Sphere({.radius = 2, .zmax = 0}, half).area(0), 2 * pi, 1e-12);
  EXPECT_NEAR(Disk({.radius = 2}, half).areaSampledByPbrt(0), 4 * pi, 1e-12);
  EXPECT_NEAR(Disk({.radius = 2}, half).area(0), pi, 1e-12);
  const TriangleMesh mesh = oneTriangle();
  EXPECT_EQ(mesh.areaSampledByPbrt(0), mesh.area(0));
}

TEST(DiffuseAreaLight, PowerIsPiTimesAreaTimesRadiance) {
  expectRgb(DiffuseAreaLight(ceiling(), 0, {.radiance = {1, 2, 3}}).power(), kPi * kPi * Rgb{1, 2, 3});
  const DiffuseAreaLight both(ceiling(), 0, {.radiance = {1, 2, 3}, .twoSided = true, .samples = 9});
  expectRgb(both.power(), 2 * kPi * kPi * Rgb{1, 2, 3});
  EXPECT_EQ(both.sampleCount(), 9);
}

}  // namespace
}  // namespace pbrtmedia
