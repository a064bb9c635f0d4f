// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/cubic_bezier.h"

#include <gtest/gtest.h>

namespace pbrtmedia {
namespace {

const CubicBezier kCurve{{Vec3d(0, 0, 0), Vec3d(1, 2, -1), Vec3d(3, -1, 0.5), Vec3d(4, 1, 2)}};

/// Bernstein form, written out.
Vec3d bernstein(const CubicBezier& c, double u) {
  const double w = 1 - u;
  return w * w * w * c.p[0] + 3 * u * w * w * c.p[1] + 3 * u * u * w * c.p[2] + u * u * u * c.p[3];
}

TEST(CubicBezier, IsItsBernsteinPolynomialAndItsPartsAreThatAsWell) {
  const auto [first, second] = kCurve.halves();
  const CubicBezier part = kCurve.part(0.25, 0.875);
  for (int i = 0; i <= 16; ++i) {
    const double u = i / 16.0, h = 1e-4;
    EXPECT_LT(length(kCurve.at(u) - bernstein(kCurve, u)), 1e-14);
    EXPECT_LT(length(first.at(u) - bernstein(kCurve, u / 2)), 1e-14);
    EXPECT_LT(length(second.at(u) - bernstein(kCurve, 0.5 + u / 2)), 1e-14);
    EXPECT_LT(length(part.at(u) - bernstein(kCurve, 0.25 + 0.625 * u)), 1e-14);
    const Vec3d slope = (bernstein(kCurve, u + h) - bernstein(kCurve, u - h)) / (2 * h);
    EXPECT_LT(length(kCurve.derivative(u) - slope), 1e-6);
  }
}

TEST(CubicBezier, IsWithinTheDistanceOfItsChordsAfterTheHalvingsItSays) {
  EXPECT_EQ(
      (CubicBezier{{Vec3d(0, 0, 0), Vec3d(1, 1, 1), Vec3d(2, 2, 2), Vec3d(3, 3, 3)}}.halvingsWithin(1e-9)),
      0);
  EXPECT_EQ(kCurve.halvingsWithin(0), 10);
  for (const double distance : {0.5, 0.1, 0.01, 0.001}) {
    const int halvings = kCurve.halvingsWithin(distance), count = 1 << halvings;
    ASSERT_LE(halvings, 10);
    for (int i = 0; i < count; ++i) {
      const CubicBezier piece = kCurve.part(double(i) / count, double(i + 1) / count);
      const Vec3d chord = normalize(piece.p[3] - piece.p[0]);
      for (int j = 0; j <= 8; ++j)
        EXPECT_LT(length(cross(piece.at(j / 8.0) - piece.p[0], chord)), 2 * distance);
    }
  }
}

/// Uniform B-spline basis functions of degree d over the last d + 1 points, by Cox and de Boor.
double basisFunction(int i, int d, double x) {
  if (d == 0) return x >= i && x < i + 1 ? 1 : 0;
  return (x - i) / d * basisFunction(i, d - 1, x) + (i + d + 1 - x) / d * basisFunction(i + 1, d - 1, x);
}

TEST(CurveSegment, OfABSplineIsTheSumOfItsBasisFunctions) {
  const std::vector<Point3f> points = {{0, 0, 0}, {1, 2, 0}, {2, -1, 1}, {4, 0, 3}, {5, 1, -1}, {7, 0, 0}};
  for (const int degree : {2, 3}) {
    const std::size_t count = curveSegmentCount(points.size(), degree, CurveBasis::BSpline);
    ASSERT_EQ(count, points.size() - static_cast<std::size_t>(degree));
    for (std::size_t segment = 0; segment < count; ++segment) {
      const CubicBezier c = curveSegment(points, segment, degree, CurveBasis::BSpline);
      for (int j = 0; j < 8; ++j) {
        Vec3d sum{};
        for (std::size_t i = 0; i < points.size(); ++i) {
          sum += basisFunction(static_cast<int>(i), degree, static_cast<double>(segment) + degree + j / 8.0) *
                 Vec3d(points[i]);
        }
        EXPECT_LT(length(c.at(j / 8.0) - sum), 1e-12) << "degree " << degree << ", segment " << segment;
      }
    }
  }
}

TEST(CurveSegment, OfBezierPointsSharesItsEnds) {
  const std::vector<Point3f> points = {{0, 0, 0},  {1, 2, 0}, {2, -1, 1}, {4, 0, 3},
                                       {5, 1, -1}, {7, 0, 0}, {8, 8, 8}};
  ASSERT_EQ(curveSegmentCount(points.size(), 3, CurveBasis::Bezier), 2u);
  ASSERT_EQ(curveSegmentCount(points.size(), 2, CurveBasis::Bezier), 3u);
  const CubicBezier last = curveSegment(points, 1, 3, CurveBasis::Bezier);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(last.p[i], Vec3d(points[3 + i]));
  const CubicBezier quadratic = curveSegment(points, 1, 2, CurveBasis::Bezier);
  const Vec3d middle = 0.25 * Vec3d(points[2]) + 0.5 * Vec3d(points[3]) + 0.25 * Vec3d(points[4]);
  EXPECT_LT(length(quadratic.at(0.5) - middle), 1e-14);
  EXPECT_EQ(quadratic.at(0), Vec3d(points[2]));
  EXPECT_EQ(quadratic.at(1), Vec3d(points[4]));
}

TEST(CurveSegment, CountsNoneWherePointsMakeNoCurve) {
  EXPECT_EQ(curveSegmentCount(0, 3, CurveBasis::Bezier), 0u);
  EXPECT_EQ(curveSegmentCount(3, 3, CurveBasis::Bezier), 0u);
  EXPECT_EQ(curveSegmentCount(5, 3, CurveBasis::Bezier), 0u);
  EXPECT_EQ(curveSegmentCount(4, 2, CurveBasis::Bezier), 0u);
  EXPECT_EQ(curveSegmentCount(3, 3, CurveBasis::BSpline), 0u);
  EXPECT_EQ(curveSegmentCount(4, 3, CurveBasis::BSpline), 1u);
  EXPECT_EQ(curveSegmentCount(2, 2, CurveBasis::BSpline), 0u);
}

}  // namespace
}  // namespace pbrtmedia
