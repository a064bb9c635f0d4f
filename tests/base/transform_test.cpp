// SPDX-License-Identifier: BSD-2-Clause
#include "base/transform.h"

#include <gtest/gtest.h>

#include "base/rng.h"

namespace pbrtmedia {
namespace {

void expectNear(Vec3d a, Vec3d b, double tolerance = 1e-13) {
  EXPECT_LE(distance(a, b), tolerance) << a << b;
}

Matrix4 randomMatrix(Rng& rng) {
  Matrix4 m;
  for (auto& row : m.m) {
    for (double& x : row) x = 2 * rng.uniformDouble() - 1;
  }
  return m;
}

TEST(Matrix4, TimesItsInverseIsIdentity) {
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const Matrix4 m = randomMatrix(rng);
    bool singular = true;
    const Matrix4 product = m * m.inverse(singular);
    EXPECT_FALSE(singular);
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(product.m[r][c], r == c, 1e-10);
    }
  }
}

TEST(Matrix4, InverseNeedsPivoting) {
  const Matrix4 m{{{{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}}}};
  bool singular = true;
  EXPECT_EQ(m.inverse(singular), m);
  EXPECT_FALSE(singular);
}

TEST(Matrix4, TellsSingularMatricesAndThenAnswersIdentity) {
  for (const Matrix4& m : {Matrix4{{{{1, 2, 0, 0}, {2, 4, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}},
                           Matrix4{{{{1, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}},
                           Matrix4{{{{std::nan(""), 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}}}) {
    bool singular = false;
    EXPECT_EQ(m.inverse(singular), Matrix4{});
    EXPECT_TRUE(singular);
    EXPECT_TRUE(Transform(m).isSingular());
    EXPECT_TRUE(Transform(m).inverse().isSingular());
    EXPECT_TRUE((Transform::translate({1, 2, 3}) * Transform(m)).isSingular());
  }
}

TEST(Matrix4, TransposesAndTakesTheDeterminantOfTheLinearPart) {
  const Matrix4 m{{{{1, 2, 3, 9}, {0, 1, 4, 9}, {5, 6, 0, 9}, {7, 7, 7, 1}}}};
  EXPECT_EQ(m.determinant3(), 1.0);
  EXPECT_EQ(m.transposed().m[3][0], 9.0);
  EXPECT_EQ(m.transposed().transposed(), m);
}

TEST(Transform, IsIdentityAtFirst) {
  EXPECT_TRUE(Transform().isIdentity());
  EXPECT_FALSE(Transform::translate({0, 0, 1}).isIdentity());
  EXPECT_EQ(Transform().point(Vec3d{1, 2, 3}), (Vec3d{1, 2, 3}));
}

TEST(Transform, TranslatesPointsButNotVectorsOrNormals) {
  const Transform t = Transform::translate({1, 2, 3});
  EXPECT_EQ(t.point(Vec3d{1, 1, 1}), (Vec3d{2, 3, 4}));
  EXPECT_EQ(t.vector(Vec3d{1, 1, 1}), (Vec3d{1, 1, 1}));
  EXPECT_EQ(t.normal(Vec3d{1, 1, 1}), (Vec3d{1, 1, 1}));
  EXPECT_EQ(t.inverse().point(Vec3d{2, 3, 4}), (Vec3d{1, 1, 1}));
}

TEST(Transform, ScalesVectorsUpAndNormalsDown) {
  const Transform s = Transform::scale(2, 4, -1);
  EXPECT_EQ(s.vector(Vec3d{1, 1, 1}), (Vec3d{2, 4, -1}));
  EXPECT_EQ(s.normal(Vec3d{1, 1, 1}), (Vec3d{0.5, 0.25, -1}));
  EXPECT_TRUE(s.swapsHandedness());
  EXPECT_FALSE(Transform::scale(-1, -1, 1).swapsHandedness());
}

TEST(Transform, NormalsStayPerpendicularUnderAnyMap) {
  Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    Matrix4 m = randomMatrix(rng);
    m.m[3] = {0, 0, 0, 1};
    const Transform t(m);
    const Vec3d u{1, 2, 3}, v{-2, 0, 1}, n = cross(u, v);
    EXPECT_NEAR(dot(t.normal(n), t.vector(u)), 0, 1e-12);
    EXPECT_NEAR(dot(t.normal(n), t.vector(v)), 0, 1e-12);
  }
}

TEST(Transform, RotatesByTheRightHandRule) {
  expectNear(Transform::rotate(90, {0, 0, 2}).point(Vec3d{1, 0, 0}), {0, 1, 0}, 0);
  expectNear(Transform::rotate(90, {1, 0, 0}).point(Vec3d{0, 1, 0}), {0, 0, 1}, 0);
  expectNear(Transform::rotate(90, {0, 1, 0}).point(Vec3d{0, 0, 1}), {1, 0, 0}, 0);
  expectNear(Transform::rotate(120, {1, 1, 1}).point(Vec3d{1, 2, 3}), {3, 1, 2});
  const double c = std::sqrt(0.75);
  expectNear(Transform::rotate(-30, {0, 0, 1}).point(Vec3d{1, 0, 0}), {c, -0.5, 0});
}

TEST(Transform, RightAnglesAreExactForAnyNumberOfTurns) {
  for (const double turns : {-720.0, 0.0, 360.0, 3600.0})
    EXPECT_TRUE(Transform::rotate(turns, {0, 1, 0}).isIdentity()) << turns;
  EXPECT_EQ(Transform::rotate(450, {0, 0, 1}).matrix(), Transform::rotate(90, {0, 0, 1}).matrix());
  EXPECT_EQ(Transform::rotate(-90, {0, 0, 1}).matrix(), Transform::rotate(270, {0, 0, 1}).matrix());
}

TEST(Transform, RotationsHaveTheirTransposeAsInverse) {
  const Transform r = Transform::rotate(37, {1, -2, 0.5});
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(r.inverseMatrix().m[i][j], r.matrix().m[j][i]);
      EXPECT_NEAR((r.matrix() * r.inverseMatrix()).m[i][j], i == j, 1e-15);
    }
  }
  EXPECT_NEAR(r.matrix().determinant3(), 1, 1e-15);
}

TEST(Transform, TheProductAppliesTheRightFactorFirst) {
  const Transform t = Transform::translate({10, 0, 0}), s = Transform::scale(2, 2, 2);
  EXPECT_EQ((t * s).point(Vec3d{1, 0, 0}), (Vec3d{12, 0, 0}));
  EXPECT_EQ((s * t).point(Vec3d{1, 0, 0}), (Vec3d{22, 0, 0}));
  EXPECT_EQ((s * t).inverse().point(Vec3d{22, 0, 0}), (Vec3d{1, 0, 0}));
}

TEST(Transform, LookAtPutsTheEyeAtTheOriginAndTheTargetOnTheAxis) {
  const auto t = Transform::lookAt({3, 4, 1.5}, {0.5, 0.5, 0}, {0, 0, 1});
  ASSERT_TRUE(t);
  expectNear(t->point(Vec3d{3, 4, 1.5}), {0, 0, 0});
  const Vec3d target = t->point(Vec3d{0.5, 0.5, 0});
  expectNear(target, {0, 0, distance(Vec3d{3, 4, 1.5}, Vec3d{0.5, 0.5, 0})});
  const Vec3d up = t->vector(Vec3d{0, 0, 1});
  EXPECT_NEAR(up.x, 0, 1e-14);
  EXPECT_GT(up.y, 0);
}

TEST(Transform, LookAtIsLeftHanded) {
  // Looking along +z with y up: +x must be to the right, and that is the identity.
  const auto t = Transform::lookAt({0, 0, 0}, {0, 0, 5}, {0, 1, 0});
  ASSERT_TRUE(t);
  EXPECT_TRUE(t->isIdentity());
  // Looking along -z, +x is to the left.
  const auto back = Transform::lookAt({0, 0, 0}, {0, 0, -5}, {0, 1, 0});
  ASSERT_TRUE(back);
  EXPECT_EQ(back->point(Vec3d{1, 0, 0}).x, -1.0);
}

TEST(Transform, LookAtAnswersNothingForADegenerateView) {
  EXPECT_FALSE(Transform::lookAt({1, 2, 3}, {1, 2, 3}, {0, 0, 1}));
  EXPECT_FALSE(Transform::lookAt({0, 0, 0}, {0, 0, 2}, {0, 0, -7}));
  EXPECT_FALSE(Transform::lookAt({0, 0, 0}, {0, 0, 2}, {0, 0, 0}));
  EXPECT_FALSE(Transform::lookAt({0.1, 0.7, 0.3}, {0.2, 0.9, 0.6}, {1, 2, 3}));  // parallel to rounding
  EXPECT_TRUE(Transform::lookAt({0, 0, 0}, {0, 0, 2}, {1e-6, 0, 1}));
}

TEST(Transform, PerspectiveMapsTheFrustumToTheScreen) {
  const Transform p = Transform::perspective(90, 0.5, 100);
  expectNear(p.point(Vec3d{0, 0, 0.5}), {0, 0, 0});
  expectNear(p.point(Vec3d{0, 0, 100}), {0, 0, 1});
  expectNear(p.point(Vec3d{3, -3, 3}), {1, -1, p.point(Vec3d{0, 0, 3}).z});
  const double half = std::tan(radians(20.0));
  EXPECT_NEAR(Transform::perspective(40, 1, 10).point(Vec3d{2 * half, 0, 2}).x, 1, 1e-14);
}

TEST(Transform, MapsRaysWithoutRenormalising) {
  const Transform t = Transform::translate({1, 0, 0}) * Transform::scale(2, 2, 2);
  const Ray r = t.ray(Ray{{1, 1, 1}, {0, 0, 1}, 7, 0.5f});
  EXPECT_EQ(r.o, (Point3f{3, 2, 2}));
  EXPECT_EQ(r.d, (Vector3f{0, 0, 2}));
  EXPECT_EQ(r.tMax, 7.0f);
  EXPECT_EQ(r.time, 0.5f);
  RayDifferential d(Ray{{0, 0, 0}, {0, 0, 1}});
  d.hasDifferentials = true;
  d.rxOrigin = {1, 0, 0};
  d.ryDirection = {0, 1, 0};
  const RayDifferential q = t.ray(d);
  EXPECT_TRUE(q.hasDifferentials);
  EXPECT_EQ(q.rxOrigin, (Point3f{3, 0, 0}));
  EXPECT_EQ(q.ryDirection, (Vector3f{0, 2, 0}));
}

TEST(Transform, BoundsHoldEveryMappedPoint) {
  Rng rng(5);
  const Bounds3f box{{-1, 0, 2}, {1, 3, 5}};
  const Transform t = Transform::rotate(33, {1, 2, 3}) * Transform::scale(1, -2, 0.5);
  const Bounds3f mapped = t.bounds(box);
  for (int i = 0; i < 500; ++i) {
    const float x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
    const Point3f p{-1 + 2 * x, 3 * y, 2 + 3 * z}, q = t.point(p);
    EXPECT_TRUE(mapped.contains(q) || distance(q, max(mapped.min, min(mapped.max, q))) < 1e-6f) << q;
  }
  EXPECT_TRUE(t.bounds(Bounds3f{}).isEmpty());
}

TEST(Transform, ALongChainFarFromTheOriginKeepsItsDigits) {
  Transform t;
  for (int i = 0; i < 360; ++i)
    t = t * Transform::translate({1e6, 0, 0}) * Transform::rotate(1, {0, 0, 1}) *
        Transform::translate({-1e6, 0, 0});
  // 360 one-degree turns about (1e6, 0, 0) that each move to a turned frame, undone by the inverse.
  expectNear(t.inverse().point(t.point(Vec3d{1, 2, 3})), {1, 2, 3}, 1e-6);
}

TEST(Affine3f, AgreesWithTheTransform) {
  const Transform t =
      Transform::translate({1, 2, 3}) * Transform::rotate(50, {1, 1, 0}) * Transform::scale(1, 2, 3);
  const Affine3f a(t.matrix());
  const Point3f p{0.5f, -1, 2};
  EXPECT_LT(distance(a.point(p), t.point(p)), 1e-5f);
  EXPECT_LT(distance(a.vector(p), t.vector(p)), 1e-5f);
  EXPECT_EQ(Affine3f().point(p), p);
}

}  // namespace
}  // namespace pbrtmedia
