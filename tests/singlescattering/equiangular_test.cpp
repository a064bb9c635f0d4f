// SPDX-License-Identifier: BSD-2-Clause
#include "singlescattering/equiangular.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/rng.h"
#include "support/statistics.h"
#include "support/z_test.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
constexpr double kInf = std::numeric_limits<double>::infinity();

struct Case {
  const char* name;
  Vec3d o, d;
  double tMin, tMax;
  Vec3d point;
};
const Case kCases[] = {
    {"light beside the middle", {0, 0, 0}, {0, 0, 1}, 0, 4, {0, 1, 2}},
    {"light behind the start", {0, 0, 0}, {0, 0, 1}, 1, 4, {0, 0.3, -2}},
    {"light beyond the end", {0, 0, 0}, {0, 0, 1}, 0, 4, {1, 0, 9}},
    {"endless", {1, 2, 3}, {0.6, 0, 0.8}, 0.5, kInf, {4, 4, 4}},
    {"endless, light behind", {0, 0, 0}, {0, 0, 1}, 2, kInf, {0, 1, -3}},
    {"direction that is no unit vector", {0, 0, 0}, {0, 0, 3}, 0, 4, {0, 2, 5}},
    {"far origin", {0, 0, -1e7}, {0, 0, 1}, 1e7 - 3, 1e7 + 3, {0, 2, 0}},
    {"tiny angle", {0, 0, 0}, {0, 0, 1}, 1e6, 1e6 + 1, {0, 1e-3, 0}},
    {"light on the line, outside", {0, 0, 0}, {0, 0, 1}, 1, 3, {0, 0, -1}},
    {"light on the line, inside", {0, 0, 0}, {0, 0, 1}, 1, 3, {0, 0, 2}},
};

/// The distribution function of the density by its closed form, from the angles: in units of t from the foot.
double cdf(const Case& c, double t) {
  const double dd = dot(c.d, c.d), foot = dot(c.point - c.o, c.d) / dd;
  const double h = std::sqrt(lengthSquared(c.o + foot * c.d - c.point) / dd);
  const auto angle = [&](double x) { return std::isinf(x) ? M_PI / 2 : std::atan((x - foot) / h); };
  return (angle(t) - angle(c.tMin)) / (angle(c.tMax) - angle(c.tMin));
}

TEST(Equiangular, SamplesInvertTheClosedFormOfTheAngles) {
  for (const Case& c : {kCases[0], kCases[1], kCases[2], kCases[3], kCases[4], kCases[5]}) {
    const auto e = Equiangular::over(c.o, c.d, c.tMin, c.tMax, c.point);
    ASSERT_TRUE(e) << c.name;
    for (int i = 0; i < 1000; ++i) {
      const double u = (i + 0.5) / 1000;
      EXPECT_NEAR(cdf(c, e->sample(u)), u, 1e-12) << c.name;
    }
  }
}

TEST(Equiangular, EvenDistancesAreTheSamplesOfEvenNumbers) {
  for (const Case& c : kCases) {
    const auto e = Equiangular::over(c.o, c.d, c.tMin, c.tMax, c.point);
    ASSERT_TRUE(e) << c.name;
    for (const int n : {1, 2, 8}) {
      int i = 0;
      e->forEven(n, [&](double t) {
        const double sample = e->sample((i++ + 0.5) / n);
        EXPECT_LE(std::abs(t - sample) * e->pdf(sample), 1e-9) << c.name << ": " << i << " of " << n;
      });
      EXPECT_EQ(i, n);
    }
  }
}

TEST(Equiangular, StaysInsideAndHasTheDensityItStatesInEveryPosition) {
  for (const Case& c : kCases) {
    const auto e = Equiangular::over(c.o, c.d, c.tMin, c.tMax, c.point);
    ASSERT_TRUE(e) << c.name;
    EXPECT_EQ(e->sample(0), c.tMin) << c.name;
    double last = c.tMin;
    constexpr int kSteps = 1 << 12;
    for (int i = 1; i < kSteps; ++i) {
      const double u = static_cast<double>(i) / kSteps, t = e->sample(u);
      ASSERT_GE(t, last) << c.name << " u " << u;
      ASSERT_LE(t, c.tMax) << c.name << " u " << u;
      // The density is the inverse slope; between two samples its extremes bound the mean slope, where the
      // stretch lies on one side of the foot (elsewhere within the curvature).
      const double slope = (1.0 / kSteps) / (t - last);
      const double a = e->pdf(last), b = e->pdf(t), m = e->pdf(0.5 * (t + last));
      if (t > last) {
        EXPECT_LE(slope, 1.01 * std::max({a, b, m})) << c.name << " u " << u;
        EXPECT_GE(slope, 0.99 * std::min({a, b, m})) << c.name << " u " << u;
      }
      last = t;
    }
    EXPECT_EQ(e->pdf(c.tMin - 1e-3 * (1 + c.tMin)), 0) << c.name;
    if (std::isfinite(c.tMax)) {
      EXPECT_EQ(e->pdf(c.tMax * 1.001), 0) << c.name;
    } else {
      EXPECT_TRUE(std::isfinite(e->sample(kOneMinusEpsilon))) << c.name;
    }
  }
}

TEST(Equiangular, WeighsAnIntegralRight) {
  // The integral of exp(-t)/r² over [0, 4] with the light at height 1 over t = 2.
  double truth = 0;
  constexpr int kSteps = 200000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * 4 / kSteps;
    truth += std::exp(-t) / (1 + (t - 2) * (t - 2)) * 4 / kSteps;
  }
  const auto e = Equiangular::over({0, 0, 0}, {0, 0, 1}, 0, 4, {0, 1, 2});
  ASSERT_TRUE(e);
  const auto draw = [&](Rng& rng) {
    const double t = e->sample(rng.uniformDouble());
    return std::exp(-t) / (1 + (t - 2) * (t - 2)) / e->pdf(t);
  };
  const test::ZTest right = test::runZTest(draw, truth, 1, 1 << 18);
  EXPECT_LT(std::abs(right.z()), kMaxAbsZ) << right;
  const auto wrong = [&](Rng& rng) { return draw(rng) * 1.02; };  // negative control
  EXPECT_GT(std::abs(test::runZTest(wrong, truth, 1, 1 << 18).z()), kMaxAbsZ);
}

TEST(Equiangular, StrengthIsTheIntegralOfTheInverseSquare) {
  const auto e = Equiangular::over({0, 0, 0}, {0, 0, 1}, 0, kInf, {0, 2, 0});
  ASSERT_TRUE(e);
  EXPECT_NEAR(e->strength(), M_PI / 2 / 2, 1e-12);
}

TEST(Equiangular, RefusesStretchesOfNoLength) {
  EXPECT_FALSE(Equiangular::over({0, 0, 0}, {0, 0, 1}, 1, 1, {0, 1, 0}));
  EXPECT_FALSE(Equiangular::over({0, 0, 0}, {0, 0, 1}, 2, 1, {0, 1, 0}));
  EXPECT_FALSE(Equiangular::over({0, 0, 0}, {0, 0, 0}, 0, 1, {0, 1, 0}));
  EXPECT_FALSE(Equiangular::over({0, 0, 0}, {0, 0, 1}, kInf, kInf, {0, 1, 0}));
  EXPECT_FALSE(Equiangular::over({0, 0, 0}, {0, 0, 1}, NAN, 1, {0, 1, 0}));
}

}  // namespace
}  // namespace pbrtmedia
