// SPDX-License-Identifier: BSD-2-Clause
#include "base/warp.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/rng.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using namespace test;

constexpr int kN = 200000;

template <class Visit>
void forRandomSquare(std::uint64_t seed, Visit&& visit) {
  Rng rng(seed);
  for (int i = 0; i < kN; ++i) {
    const float u = rng.uniform();
    visit(Point2f{u, rng.uniform()});
  }
}

/// 16 x 16 cells of equal probability: `a` and `b` in [0, 1] must be independent and uniform.
class Cells {
 public:
  void add(double a, double b) {
    const auto cell = [](double x) { return static_cast<std::size_t>(std::clamp(x * 16, 0.0, 15.0)); };
    ++counts_[cell(a) * 16 + cell(b)];
  }
  ChiSquareTest test() const { return chiSquareUniform(counts_); }

 private:
  std::vector<double> counts_ = std::vector<double>(256);
};

double turn(double y, double x) {
  const double phi = std::atan2(y, x) / (2 * std::numbers::pi);
  return phi < 0 ? phi + 1 : phi;
}

TEST(SampleConcentricDisk, MapsCentreAndCorners) {
  EXPECT_EQ(sampleConcentricDisk({0.5f, 0.5f}), (Point2f{0, 0}));
  const Point2f east = sampleConcentricDisk({kOneMinusEpsilon, 0.5f}), corner = sampleConcentricDisk({0, 0});
  EXPECT_NEAR(east.x, 1, 1e-6);
  EXPECT_NEAR(east.y, 0, 1e-6);
  EXPECT_NEAR(corner.x, -std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(corner.y, -std::sqrt(0.5), 1e-6);
}

TEST(SampleConcentricDisk, IsUniformInArea) {
  Cells cells;
  forRandomSquare(1, [&](Point2f u) {
    const Point2d d(sampleConcentricDisk(u));
    ASSERT_LE(d.x * d.x + d.y * d.y, 1.000001);
    cells.add(d.x * d.x + d.y * d.y, turn(d.y, d.x));
  });
  EXPECT_GT(cells.test().pValue(), kMinPValue) << cells.test();
}

TEST(SampleConcentricDisk, IsContinuousAcrossTheDiagonals) {
  for (const float t : {0.1f, 0.3f, 0.7f, 0.9f}) {
    const Point2f a = sampleConcentricDisk({t, t + 1e-6f}), b = sampleConcentricDisk({t + 1e-6f, t});
    EXPECT_NEAR(a.x, b.x, 1e-5);
    EXPECT_NEAR(a.y, b.y, 1e-5);
  }
}

TEST(SampleCosineHemisphere, HasDensityCosineOverPi) {
  Cells cells;
  forRandomSquare(2, [&](Point2f u) {
    const Vector3f w = sampleCosineHemisphere(u);
    ASSERT_NEAR(length(w), 1, 1e-5);
    ASSERT_GE(w.z, 0.0f);
    cells.add(double{w.z} * w.z, turn(w.y, w.x));  // cumulative distribution of cos: cos^2
  });
  EXPECT_GT(cells.test().pValue(), kMinPValue) << cells.test();
  EXPECT_EQ(pdfCosineHemisphere(0.5f), 0.5f * kInvPi);
  EXPECT_EQ(pdfCosineHemisphere(-0.5f), 0.0f);
}

TEST(SampleUniformSphere, IsUniformInSolidAngle) {
  Cells cells;
  forRandomSquare(3, [&](Point2f u) {
    const Vector3f w = sampleUniformSphere(u);
    ASSERT_NEAR(length(w), 1, 1e-5);
    cells.add((w.z + 1.0) / 2, turn(w.y, w.x));
  });
  EXPECT_GT(cells.test().pValue(), kMinPValue) << cells.test();
  EXPECT_FLOAT_EQ(pdfUniformSphere() * 4 * kPi, 1.0f);
}

TEST(SampleUniformHemisphere, IsUniformInSolidAngle) {
  Cells cells;
  forRandomSquare(4, [&](Point2f u) {
    const Vector3f w = sampleUniformHemisphere(u);
    ASSERT_NEAR(length(w), 1, 1e-5);
    ASSERT_GE(w.z, 0.0f);
    cells.add(w.z, turn(w.y, w.x));
  });
  EXPECT_GT(cells.test().pValue(), kMinPValue) << cells.test();
  EXPECT_FLOAT_EQ(pdfUniformHemisphere() * 2 * kPi, 1.0f);
}

TEST(SampleUniformHemisphere, IsNotTakenForCosineWeighted) {
  Cells cells;
  forRandomSquare(4, [&](Point2f u) {
    const Vector3f w = sampleUniformHemisphere(u);
    cells.add(double{w.z} * w.z, turn(w.y, w.x));
  });
  EXPECT_LT(cells.test().pValue(), kMinPValue) << cells.test();
}

TEST(SampleUniformCone, IsUniformInSolidAngle) {
  const float oneMinusCosMax = 0.3f;
  Cells cells;
  forRandomSquare(5, [&](Point2f u) {
    const Vector3f w = sampleUniformCone(u, oneMinusCosMax);
    ASSERT_NEAR(length(w), 1, 1e-5);
    cells.add((1.0 - w.z) / oneMinusCosMax, turn(w.y, w.x));
  });
  EXPECT_GT(cells.test().pValue(), kMinPValue) << cells.test();
  EXPECT_FLOAT_EQ(pdfUniformCone(oneMinusCosMax), 1 / (2 * kPi * 0.3f));
  EXPECT_FLOAT_EQ(pdfUniformCone(2), pdfUniformSphere());
}

TEST(SampleUniformCone, KeepsTheDigitsOfATinyCone) {
  const float oneMinusCosMax = 5e-15f;  // half-angle 1e-7: cosMax itself rounds to 1
  const Vector3f rim = sampleUniformCone({kOneMinusEpsilon, 0}, oneMinusCosMax);
  EXPECT_NEAR(rim.x / 1e-7f, 1, 1e-5);
  const Vector3f half = sampleUniformCone({0.25f, 0}, oneMinusCosMax);
  EXPECT_NEAR(half.x / rim.x, 0.5, 1e-5);
}

TEST(SampleUniformTriangle, IsUniformInArea) {
  // P(b0 < x) = 1 - (1 - x)^2, and given b0, b1 is uniform in [0, 1 - b0].
  Cells cells;
  forRandomSquare(6, [&](Point2f u) {
    const Point2d b(sampleUniformTriangle(u));
    ASSERT_GE(b.x, 0.0);
    ASSERT_GE(b.y, 0.0);
    ASSERT_LE(b.x + b.y, 1.0);
    if (b.x < 1) cells.add(1 - (1 - b.x) * (1 - b.x), b.y / (1 - b.x));
  });
  EXPECT_GT(cells.test().pValue(), kMinPValue) << cells.test();
}

TEST(PowerHeuristic, WeightsOfBothTechniquesSumToOne) {
  for (const float a : {1e-20f, 0.5f, 3.0f, 1e30f}) {
    for (const float b : {1e-20f, 0.5f, 3.0f, 1e30f}) {
      EXPECT_FLOAT_EQ(powerHeuristic(a, b) + powerHeuristic(b, a), 1.0f);
      EXPECT_TRUE(std::isfinite(powerHeuristic(a, b)));
    }
  }
  EXPECT_EQ(powerHeuristic(1, 2), 0.2f);
  EXPECT_EQ(powerHeuristic(0, 2), 0.0f);
  EXPECT_EQ(powerHeuristic(2, 0), 1.0f);
}

}  // namespace
}  // namespace pbrtmedia
