// SPDX-License-Identifier: BSD-2-Clause
#include "base/animated_transform.h"

#include <gtest/gtest.h>

#include "base/rng.h"

namespace pbrtmedia {
namespace {

void expectSame(const Transform& a, const Transform& b, double tolerance = 1e-12) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_NEAR(a.matrix().m[i][j], b.matrix().m[i][j], tolerance) << i << ' ' << j;
      EXPECT_NEAR(a.inverseMatrix().m[i][j], b.inverseMatrix().m[i][j], tolerance) << i << ' ' << j;
    }
  }
}

TEST(AnimatedTransform, OfEqualEndsIsNotAnimated) {
  const Transform t = Transform::rotate(30, {1, 2, 3});
  const AnimatedTransform a(t, 0, t, 1);
  EXPECT_FALSE(a.isAnimated());
  EXPECT_EQ(a.at(0.3), t);
  EXPECT_FALSE(AnimatedTransform().isAnimated());
  EXPECT_TRUE(AnimatedTransform().at(0.5).isIdentity());
}

TEST(AnimatedTransform, CopiesShareWhatTheyHold) {
  const AnimatedTransform one(Transform::translate({1, 2, 3})), copy = one, identity, other;
  EXPECT_EQ(&one.start(), &copy.start());
  EXPECT_EQ(&one.end(), &one.start()) << "nothing is kept of a motion that is none";
  EXPECT_EQ(&identity.start(), &other.start());
  EXPECT_TRUE(identity.start().isIdentity());
}

TEST(AnimatedTransform, GivesTheEndMatricesAtAndBeyondTheEnds) {
  const Transform s = Transform::rotate(30, {1, 2, 3}) * Transform::scale(1, 2, 3),
                  e = Transform::translate({5, 0, 0});
  const AnimatedTransform a(s, 2, e, 4);
  EXPECT_TRUE(a.isAnimated());
  EXPECT_EQ(a.at(2), s);
  EXPECT_EQ(a.at(-1), s);
  EXPECT_EQ(a.at(4), e);
  EXPECT_EQ(a.at(9), e);
}

TEST(AnimatedTransform, ApproachesItsEndsContinuously) {
  const Transform s =
      Transform::translate({1, 2, 3}) * Transform::rotate(30, {1, 2, 3}) * Transform::scale(1, 2, 3);
  const Transform e = Transform::rotate(200, {0, 1, 3}) * Transform::scale(2, 0.5, 1);
  const AnimatedTransform a(s, 0, e, 1);
  expectSame(a.at(1e-13), s);
  expectSame(a.at(1 - 1e-13), e);
}

TEST(AnimatedTransform, MovesTranslationsLinearly) {
  const AnimatedTransform a(Transform::translate({0, 0, 2}), 1, Transform::translate({4, 8, 2}), 3);
  expectSame(a.at(1.5), Transform::translate({1, 2, 2}));
}

TEST(AnimatedTransform, TurnsAtConstantSpeed) {
  const Vec3d axis{1, -2, 0.5};
  const AnimatedTransform a(Transform::rotate(10, axis), 0, Transform::rotate(130, axis), 1);
  for (const double u : {0.1, 0.25, 0.5, 0.9}) expectSame(a.at(u), Transform::rotate(10 + 120 * u, axis));
}

TEST(AnimatedTransform, TurnsAlongTheShorterArc) {
  const AnimatedTransform a(Transform(), 0, Transform::rotate(270, {0, 0, 1}), 1);
  expectSame(a.at(0.5), Transform::rotate(-45, {0, 0, 1}));
}

TEST(AnimatedTransform, TurnsByNearlyHalfATurnAboutEveryAxis) {
  // Each axis takes another branch of the matrix-to-quaternion conversion.
  for (const Vec3d axis : {Vec3d{1, 0.1, 0}, Vec3d{0.1, 1, 0}, Vec3d{0, 0.1, 1}, Vec3d{1, 1, 1}}) {
    const AnimatedTransform a(Transform(), 0, Transform::rotate(179, axis), 1);
    expectSame(a.at(0.5), Transform::rotate(89.5, axis), 1e-10);
  }
}

TEST(AnimatedTransform, InterpolatesStretchLinearly) {
  const AnimatedTransform a(Transform::scale(1, 2, 3), 0, Transform::scale(3, 2, 1), 1);
  expectSame(a.at(0.25), Transform::scale(1.5, 2, 2.5));
}

TEST(AnimatedTransform, SeparatesTurningFromStretching) {
  const auto make = [](double degrees, double s) {
    return Transform::rotate(degrees, {0, 1, 0}) * Transform::scale(s, 1, 1);
  };
  const AnimatedTransform a(make(0, 1), 0, make(80, 3), 1);
  expectSame(a.at(0.5), make(40, 2));
}

TEST(AnimatedTransform, KeepsAMirrorMirrored) {
  const auto make = [](double degrees) {
    return Transform::rotate(degrees, {0, 0, 1}) * Transform::scale(-1, 1, 1);
  };
  const AnimatedTransform a(make(0), 0, make(90), 1);
  expectSame(a.at(0.5), make(45));
  EXPECT_TRUE(a.at(0.3).swapsHandedness());
}

TEST(AnimatedTransform, TinyTurnsStaySmooth) {
  const AnimatedTransform a(Transform(), 0, Transform::rotate(1e-5, {0, 0, 1}), 1);
  expectSame(a.at(0.5), Transform::rotate(0.5e-5, {0, 0, 1}), 1e-15);
}

TEST(MotionBounds, HoldTheBoxAtEveryTime) {
  const Bounds3f box{{1, 1, 0}, {2, 3, 1}};
  for (const double degrees : {5.0, 90.0, 179.0}) {
    const AnimatedTransform a(
        Transform::rotate(20, {1, 0, 0}), 0,
        Transform::translate({1, 0, 0}) * Transform::rotate(degrees, {0, 0.1, 1}) * Transform::scale(1, 2, 1),
        1);
    const Bounds3f bounds = a.motionBounds(box);
    for (int k = 0; k <= 1000; ++k) {
      const Transform t = a.at(k / 1000.0);
      for (int c = 0; c < 8; ++c) EXPECT_TRUE(bounds.contains(t.point(box.corner(c)))) << degrees << ' ' << k;
    }
    EXPECT_LT(maxComponent(bounds.diagonal()), 20.0f);  // and they are not just everything
  }
}

TEST(MotionBounds, AreExactWithoutMotionAndEmptyForNothing) {
  const Bounds3f box{{1, 1, 0}, {2, 3, 1}};
  EXPECT_EQ(AnimatedTransform(Transform::translate({1, 0, 0})).motionBounds(box),
            (Bounds3f{{2, 1, 0}, {3, 3, 1}}));
  const AnimatedTransform moving(Transform(), 0, Transform::translate({1, 0, 0}), 1);
  EXPECT_TRUE(moving.motionBounds(Bounds3f{}).isEmpty());
}

TEST(AnimatedTransform, WithoutTimeBetweenTheEndsItJumps) {
  const AnimatedTransform jump(Transform(), 0.5, Transform::translate({5, 0, 0}), 0.5);
  EXPECT_EQ(jump.at(0.5).point(Vec3d{}), Vec3d(0, 0, 0));
  EXPECT_EQ(jump.at(0.75).point(Vec3d{}), Vec3d(5, 0, 0));
  const Bounds3f bounds = jump.motionBounds(Bounds3f{Point3f(0, 0, 0), Point3f(1, 1, 1)});
  EXPECT_LE(bounds.min.x, 0);
  EXPECT_GE(bounds.max.x, 6);
}

}  // namespace
}  // namespace pbrtmedia
