// SPDX-License-Identifier: BSD-2-Clause
#include "base/vec.h"

#include <gtest/gtest.h>

#include <sstream>

#include "base/rng.h"
#include "base/warp.h"

namespace pbrtmedia {
namespace {

TEST(Vec3, AddsScalesAndCompares) {
  const Vec3d a{1, 2, 3}, b{4, -5, 6};
  EXPECT_EQ(a + b, (Vec3d{5, -3, 9}));
  EXPECT_EQ(a - b, (Vec3d{-3, 7, -3}));
  EXPECT_EQ(2.0 * a, a * 2.0);
  EXPECT_EQ(a / 2.0, (Vec3d{0.5, 1, 1.5}));
  EXPECT_EQ(-a, (Vec3d{-1, -2, -3}));
  EXPECT_EQ(dot(a, b), 12.0);
  EXPECT_EQ(absDot(a, -b), 12.0);
  EXPECT_EQ(cross(a, b), (Vec3d{27, 6, -13}));
  EXPECT_EQ(min(a, b), (Vec3d{1, -5, 3}));
  EXPECT_EQ(max(a, b), (Vec3d{4, 2, 6}));
  EXPECT_EQ(abs(b), (Vec3d{4, 5, 6}));
  EXPECT_EQ(maxComponent(b), 6.0);
  EXPECT_EQ(length(Vec3d{2, 3, 6}), 7.0);
  EXPECT_EQ(distance(a, Vec3d{1, 5, 7}), 5.0);
  Vec3d c = a;
  c += b;
  c *= 2;
  c -= b;
  c /= 2;
  EXPECT_EQ(c, (Vec3d{3, -0.5, 6}));
}

TEST(Vec3, IsReadAndWrittenByIndex) {
  Vec3d a{1, 2, 3};
  for (std::size_t i = 0; i < 3; ++i) a[i] += 10;
  EXPECT_EQ(a, (Vec3d{11, 12, 13}));
  Point2i p{1, 2};
  p[0] = 5;
  EXPECT_EQ(p[0] * 10 + p[1], 52);
}

TEST(Vec2, AddsAndScales) {
  EXPECT_EQ(((Point2d{1, 2} + Point2d{3, 5}) * 2.0 - Point2d{1, 1} / 2.0), (Point2d{7.5, 13.5}));
}

TEST(Vec3, PrintsItsComponents) {
  std::ostringstream os;
  os << Vec3d{1, 2.5, -3} << Point2i{4, 5};
  EXPECT_EQ(os.str(), "(1 2.5 -3)(4 5)");
}

TEST(Vec3, CrossProductOfNearlyParallelFloatsKeepsItsDigits) {
  const Vector3f a{1, 1, 0}, b{1, 1 + 0x1p-20f, 0};  // in float products 1 * (1 + e) - 1 * 1 would round
  EXPECT_EQ(cross(a, b), (Vector3f{0, 0, 0x1p-20f}));
  const Vector3f c{1.1f, 1.3f, 0.7f}, d{1.1000001f, 1.3f, 0.7f};
  const Vec3d exact = cross(Vec3d(c), Vec3d(d));
  EXPECT_NEAR(cross(c, d).y, exact.y, 1e-7 * std::abs(exact.y));
}

TEST(Vec3, NormalisedVectorsHaveLengthOne) {
  EXPECT_EQ(normalize(Vec3d{0, -3, 4}), (Vec3d{0, -0.6, 0.8}));
  EXPECT_NEAR(length(normalize(Vec3d{1e100, 2e100, -1e100})), 1.0, 1e-15);
}

TEST(Vec3, FindsInfinityAndNotANumber) {
  EXPECT_TRUE(isFinite(Vector3f{1, 2, 3}));
  EXPECT_FALSE(isFinite(Vector3f{1, std::nanf(""), 3}));
  EXPECT_FALSE(isFinite(Point2f{1, INFINITY}));
}

TEST(FaceForward, FlipsOnlyWhatPointsAway) {
  EXPECT_EQ(faceForward(Vec3d{0, 0, 1}, Vec3d{1, 0, -1}), (Vec3d{0, 0, -1}));
  EXPECT_EQ(faceForward(Vec3d{0, 0, 1}, Vec3d{1, 0, 1}), (Vec3d{0, 0, 1}));
  EXPECT_EQ(faceForward(Vec3d{0, 0, 1}, Vec3d{1, 0, 0}), (Vec3d{0, 0, 1}));
}

void expectRightHandedBasis(Vec3d n) {
  const auto [t, b] = coordinateSystem(n);
  EXPECT_NEAR(length(t), 1, 1e-14) << n;
  EXPECT_NEAR(length(b), 1, 1e-14) << n;
  EXPECT_NEAR(dot(t, b), 0, 1e-14) << n;
  EXPECT_NEAR(dot(t, n), 0, 1e-14) << n;
  EXPECT_NEAR(distance(cross(t, b), n), 0, 1e-14) << n;
}

TEST(CoordinateSystem, IsRightHandedAndOrthonormalEverywhere) {
  for (const double s : {1.0, -1.0}) {
    expectRightHandedBasis({s, 0, 0});
    expectRightHandedBasis({0, s, 0});
    expectRightHandedBasis({0, 0, s});
    expectRightHandedBasis(normalize(Vec3d{1e-9, 1e-10, s}));
    expectRightHandedBasis({1, 0, std::copysign(0.0, s)});
  }
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const float u = rng.uniform();  // named, since the order of arguments is not fixed
    expectRightHandedBasis(normalize(Vec3d(sampleUniformSphere({u, rng.uniform()}))));
  }
}

TEST(Frame, TakesVectorsThereAndBack) {
  const Frame frame = Frame::fromZ(normalize(Vector3f{1, -2, -3}));
  const Vector3f v{0.3f, -0.5f, 0.7f};
  EXPECT_LT(distance(frame.toWorld(frame.toLocal(v)), v), 1e-6f);
  EXPECT_LT(distance(frame.toLocal(frame.n), Vector3f{0, 0, 1}), 1e-6f);
}

}  // namespace
}  // namespace pbrtmedia
