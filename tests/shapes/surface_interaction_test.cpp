// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/surface_interaction.h"

#include <gtest/gtest.h>

#include "shapes/shape_probe.h"

namespace pbrtmedia {
namespace {

/// The plane z = 0 with dp/du = (2, 0, 0), dp/dv = (1, 4, 0).
SurfaceInteraction onPlane() {
  SurfaceInteraction si;
  si.n = {0, 0, 1};
  si.dpdu = {2, 0, 0};
  si.dpdv = {1, 4, 0};
  si.shading = {si.n, si.dpdu, si.dpdv, {}, {}};
  si.wo = {0, 0, 1};
  return si;
}

TEST(SurfaceInteraction, FootprintIsWhereTheAuxiliaryRaysMeetTheTangentPlane) {
  SurfaceInteraction si = onPlane();
  RayDifferential ray(test::makeRay({0, 0, 3}, {0, 0, -1}));
  ray.hasDifferentials = true;
  ray.rxOrigin = {0.5f, 0, 3};
  ray.rxDirection = {0, 0, -1};
  ray.ryOrigin = {0, 0, 3};
  ray.ryDirection = {1, 1, -1};  // meets the plane at (3, 3)
  si.computeDifferentials(ray);
  EXPECT_EQ(si.dpdx, Vector3f(0.5f, 0, 0));
  EXPECT_EQ(si.dpdy, Vector3f(3, 3, 0));
  EXPECT_FLOAT_EQ(si.dudx, 0.25f);
  EXPECT_NEAR(si.dvdx, 0, 1e-7f);
  EXPECT_FLOAT_EQ(si.dvdy, 0.75f);
  EXPECT_FLOAT_EQ(si.dudy, (3 - 0.75f) / 2);
}

TEST(SurfaceInteraction, FootprintIsZeroWithoutDifferentialsAndWhenItDoesNotExist) {
  const auto expectZero = [](const SurfaceInteraction& si) {
    EXPECT_EQ(si.dpdx, Vector3f());
    EXPECT_EQ(si.dpdy, Vector3f());
    EXPECT_EQ(si.dudx, 0);
    EXPECT_EQ(si.dvdy, 0);
  };
  RayDifferential ray(test::makeRay({0, 0, 3}, {0, 0, -1}));
  SurfaceInteraction si = onPlane();
  si.dpdx = {1, 2, 3};
  si.dudx = 1;
  si.computeDifferentials(ray);
  expectZero(si);
  ray.hasDifferentials = true;
  ray.rxOrigin = ray.ryOrigin = {0, 0, 3};
  ray.rxDirection = {1, 0, 0};  // parallel to the plane
  ray.ryDirection = {0, 0, -1};
  si.computeDifferentials(ray);
  expectZero(si);
}

TEST(SurfaceInteraction, ShadingNormalsAndGeometricNormalsTakeOneSide) {
  SurfaceInteraction si = onPlane();
  const Normal3f below(0, 0.6f, -0.8f);
  si.setShading(below, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {}, false);
  EXPECT_EQ(si.n, Normal3f(0, 0, 1));
  EXPECT_EQ(si.shading.n, -below);
  EXPECT_EQ(si.shading.dndu, Normal3f(-1, 0, 0));
  si.setShading(below, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {}, true);
  EXPECT_EQ(si.n, Normal3f(0, 0, -1));
  EXPECT_EQ(si.shading.n, below);
  EXPECT_EQ(si.shading.dndu, Normal3f(1, 0, 0));
}

TEST(SurfaceInteraction, DerivativesOfNormalsAreMappedAsNormalsAre) {
  SurfaceInteraction si = onPlane();
  si.dndu = si.shading.dndu = {1, 2, 3};
  const auto scaled = transformInteraction(Transform::scale(0.2, 0.2, 0.2), si);
  EXPECT_EQ(scaled.n, si.n);
  EXPECT_LT(length(scaled.dndu - Normal3f(5, 10, 15)), 1e-5f) << "PBRT-v3: by 1/scale";
  EXPECT_LT(length(scaled.shading.dndu - Normal3f(5, 10, 15)), 1e-5f);
  const auto stretched = transformInteraction(Transform::scale(0.5, 1, 2), si);
  EXPECT_LT(length(stretched.dndu - Normal3f(2, 2, 1.5f)), 1e-5f);
  const auto turned = transformInteraction(Transform::rotate(90, {0, 0, 1}), si);
  EXPECT_LT(length(turned.dndu - Normal3f(-2, 1, 3)), 1e-5f);
}

TEST(SurfaceInteraction, TransformedOneEqualsThatOfTheTransformedShape) {
  const Transform t =
      Transform::translate({1, 2, 3}) * Transform::rotate(50, {1, 1, 0}) * Transform::scale(0.5, 2, 1.25);
  const Sphere here({}, {}), there({}, {t, false});
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const Vector3f d = test::randomDirection(rng);
    const Ray ray = test::makeRay(-3.0f * d, d);
    const auto a = transformInteraction(t, *test::Probe(here).at(ray)),
               b = *test::Probe(there).at(t.ray(ray));
    const auto expectNear = [](Vector3f x, Vector3f y) { EXPECT_LT(length(x - y), 2e-5f * (1 + length(y))); };
    expectNear(a.p, b.p);
    expectNear(a.n, b.n);
    expectNear(a.wo, b.wo);
    expectNear(a.dpdu, b.dpdu);
    expectNear(a.dpdv, b.dpdv);
    expectNear(a.dndu, b.dndu);
    expectNear(a.dndv, b.dndv);
    expectNear(a.shading.n, b.shading.n);
    EXPECT_NEAR(length(a.wo), 1, 1e-6f);
  }
}

}  // namespace
}  // namespace pbrtmedia
