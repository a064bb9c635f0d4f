// SPDX-License-Identifier: BSD-2-Clause
#include "fields/canonical_function.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pbrtmedia {
namespace {

/// Five-point Gauss-Legendre quadrature on `n` parts of each stretch between knots.
double quadrature(const CanonicalFunction& f, double a, double b, int n = 4000) {
  constexpr std::array<double, 3> kNodes{0, 0.53846931010568309, 0.90617984593866399};
  constexpr std::array<double, 3> kWeights{128.0 / 225, 0.47862867049936647, 0.23692688505618909};
  double sum = 0;
  std::vector<double> cuts{a};
  for (const double knot : f.knots()) {
    if (knot > a && knot < b) cuts.push_back(knot);
  }
  cuts.push_back(b);
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    const double half = (cuts[k] - cuts[k - 1]) / n / 2;
    for (int i = 0; i < n; ++i) {
      const double middle = cuts[k - 1] + (2 * i + 1) * half;
      double part = kWeights[0] * f(middle);
      for (std::size_t j = 1; j < 3; ++j) {
        part += kWeights[j] * (f(middle - kNodes[j] * half) + f(middle + kNodes[j] * half));
      }
      sum += half * part;
    }
  }
  return sum;
}

CanonicalFunction named(std::string_view name) {
  const auto found = findCanonicalFunction(name);
  EXPECT_TRUE(found) << name;
  return found.value();
}

class EveryFunction : public ::testing::TestWithParam<std::string_view> {
 protected:
  CanonicalFunction f_ = named(GetParam());
};

TEST_P(EveryFunction, IsCalledAsItIsFound) {
  EXPECT_EQ(f_.about().name, GetParam());
  EXPECT_FALSE(f_.about().formula.empty());
  EXPECT_FALSE(f_.about().source.empty());
}

TEST_P(EveryFunction, IntegralsAgreeWithQuadrature) {
  const double w = f_.width(), scale = f_.integral();
  EXPECT_NEAR(f_.integral() / quadrature(f_, 0, w), 1, 1e-12);
  for (const auto& [a, b] : {std::pair{0.0, 0.3}, {0.1, 0.62}, {0.25, 0.26}, {0.599, 0.61}, {0.7, 1.0}}) {
    EXPECT_NEAR(f_.integral(a * w, b * w), quadrature(f_, a * w, b * w), 1e-12 * scale) << a << ' ' << b;
  }
  EXPECT_EQ(f_.integral(0.3 * w, 0.3 * w), 0);
}

TEST_P(EveryFunction, ExtremaAgreeWithADenseSearch) {
  constexpr int kPoints = 200000;
  for (const auto& [a, b] : {std::pair{0.0, 1.0}, {0.1, 0.3}, {0.31, 0.33}, {0.55, 0.95}}) {
    const double from = a * f_.width(), to = b * f_.width();
    const CanonicalFunction::Range range = f_.range(from, to);
    double least = f_(from), most = least;
    for (int i = 0; i <= kPoints; ++i) {
      const double value = f_(std::min(to, from + (to - from) * i / kPoints));
      least = std::min(least, value);
      most = std::max(most, value);
    }
    // Bounds, and tight ones: a turning point is missed by half a step at most, a smooth function then by
    // half its second derivative (below 2e5) times that squared.
    EXPECT_LE(range.min, least);
    EXPECT_GE(range.max, most);
    EXPECT_NEAR(range.min, least, 1e-6);
    EXPECT_NEAR(range.max, most, 1e-6);
  }
}

TEST_P(EveryFunction, IsNeverNegativeAndKnotsSpanTheDomain) {
  EXPECT_EQ(f_.knots().front(), 0);
  EXPECT_EQ(f_.knots().back(), f_.width());
  EXPECT_TRUE(std::is_sorted(f_.knots().begin(), f_.knots().end()));
  for (int i = 0; i <= 10000; ++i) EXPECT_GE(f_(f_.width() * i / 10000), 0);
  EXPECT_EQ(f_(-1), f_(0));
  EXPECT_EQ(f_(f_.width() + 1), f_(f_.width()));
}

INSTANTIATE_TEST_SUITE_P(CanonicalFunction, EveryFunction, ::testing::ValuesIn(canonicalFunctionNames()),
                         [](const auto& tested) {
                           std::string name(tested.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(CanonicalFunction, HasTheThicknessAndTightRatioOfThePaper) {
  struct Row {
    std::string_view name;
    double thickness, tightRatio;  // the ratio: requested thickness / thickness of the tight control
  };
  for (const Row& row : {Row{"constant", 1, 1}, Row{"cosine", 1.010572, 0.5}, Row{"gaussian", 1, 0.12533},
                         Row{"hole", 1, 0.87467}, Row{"linear-up", 1, 0.5}, Row{"linear-down", 1, 0.5}}) {
    const CanonicalFunction f = named(row.name);
    EXPECT_NEAR(f.integral(), row.thickness, 5e-7) << row.name;
    EXPECT_NEAR(1 / f.range().max, row.tightRatio, 5e-6) << row.name;
  }
}

TEST(CanonicalFunction, CompositeFunctionsHaveTheExtremaOfThePaper) {
  const CanonicalFunction composite = named("composite-sine"), steps = named("step-sine"),
                          gaussian = named("gaussian-m23");
  EXPECT_NEAR(composite.integral(), 1, 5e-6);
  EXPECT_NEAR(composite.range().max, 1.6463, 5e-5);
  EXPECT_NEAR(composite.range().min, 0.4403, 5e-5);
  EXPECT_NEAR(gaussian.integral(), 1, 5e-4);
  EXPECT_NEAR(steps.range().max, 3.2158, 5e-5);
  EXPECT_NEAR(steps.range().min, 0.1564, 5e-5);
  // Half a digit of the printed value, and half a digit of each of the five printed amplitudes.
  EXPECT_NEAR(std::exp(-steps.integral(0, 1)), 0.8123, 5e-5 + 5 * 5e-7);
  EXPECT_NEAR(std::exp(-steps.integral(0, 3)), 0.0016, 5e-5);
}

/// From another implementation of the generator, whose first ten sines are the printed ones of
/// composite-sine.
TEST(CanonicalFunction, NoiseIsThatOfThePublishedGenerator) {
  const CanonicalFunction noise = named("noise-30");
  EXPECT_NEAR(noise.integral(), 1, 1e-12);
  const double expected[][2] = {{0, 1.4912081141896922},
                                {.25, .9957855790747009},
                                {.5, .8784598015901504},
                                {.77, 1.0669592241214032},
                                {1, .7449392470291161}};
  for (const auto& [x, value] : expected) EXPECT_NEAR(noise(x), value, 1e-12) << x;
}

TEST(CanonicalFunction, TheMediumOfSzirmayKalosHasItsNumbers) {
  const CanonicalFunction f = named("szirmay-kalos");
  double square = 0;
  constexpr int kN = 400000;
  for (int i = 0; i < kN; ++i) {
    const double z = (i + .5) * 20 / kN;
    const double expected = std::pow((std::cos(1.5 * z) + 1) / 2, 5) * (std::sin(z / 2) + 2) / 3;
    ASSERT_NEAR(f(z), expected, 1e-14);
    square += expected * expected * 20 / kN;
  }
  EXPECT_NEAR(f.integral(), 3.415684, 5e-7);
  EXPECT_NEAR(square, 1.960753, 5e-7);
  EXPECT_NEAR(f.range().max, .95598, 5e-6);
}

TEST(CanonicalFunction, FamiliesHaveAMemberForEachPlace) {
  ASSERT_EQ(densityFamilyNames().size(), 1u);
  EXPECT_FALSE(findDensityFamily("slap", 0));
  const CanonicalFunction smooth = findDensityFamily("slab", 0).value(),
                          rough = findDensityFamily("slab", 1).value();
  for (const double t : {.1, .5, .9}) {
    double sum = 2.2;
    for (int k = 0; k < 8; ++k) {
      sum += std::exp2(-2. * k) * std::cos(2 * std::numbers::pi * std::exp2(k) * 1.37 * t + .7 * k * k);
    }
    EXPECT_NEAR(
        smooth(t) / smooth(.3),
        sum /
            [] {
              double at = 2.2;
              for (int k = 0; k < 8; ++k) {
                at += std::exp2(-2. * k) *
                      std::cos(2 * std::numbers::pi * std::exp2(k) * 1.37 * .3 + .7 * k * k);
              }
              return at;
            }(),
        1e-12);
  }
  EXPECT_NEAR(smooth.integral(), 1, 1e-12);
  EXPECT_NEAR(rough.integral(), 1, 1e-12);
  EXPECT_GT(rough.range().max, 1.2 * smooth.range().max);
}

TEST(CanonicalFunction, FractalsHaveTheExtremaOfTheirDefinition) {
  EXPECT_NEAR(named("fractal-a").range().max, 2.136, 5e-4);
  EXPECT_NEAR(named("fractal-a").integral(), 1, 1e-14);
  // Before scaling the mean is 3.80373 and the constant term 0.8 + 6 x, so 6 x becomes 1.577399 x.
  const CanonicalFunction b = named("fractal-b");
  EXPECT_NEAR(b.integral(), 1, 1e-14);
  EXPECT_NEAR(b(1) - b(0),
              (6 + 0.3 *
                       [] {
                         double difference = 0;
                         for (int k = 0; k < 8; ++k) {
                           const double phase = 0.7 * k * k;
                           difference += std::exp2(-0.5 * k) *
                                         (std::cos(2 * M_PI * std::exp2(k) * 1.37 + phase) - std::cos(phase));
                         }
                         return difference;
                       }()) /
                  3.80373,
              1e-5);
}

TEST(CanonicalFunction, BothValuesOfAJumpBelongToARangeThatTouchesIt) {
  const CanonicalFunction step = named("step");
  EXPECT_EQ(step.range(0.2, 0.6).max, 2.2);
  EXPECT_EQ(step.range(0.6, 0.8).min, 0.2);
  EXPECT_EQ(step.range(0.2, 0.5999).max, 0.2);
  EXPECT_EQ(step(0.6), 2.2);
  EXPECT_TRUE(step.isPiecewisePolynomial());
  EXPECT_FALSE(named("cosine").isPiecewisePolynomial());
}

TEST(CanonicalFunction, ClampedStretchesIntegrateToZero) {
  // max(0, 1 - 2 x): the triangle on [0, 1/2].
  const CanonicalFunction f({"ramp", "max(0, 1 - 2 x)", "test"}, {{.end = 1, .constant = 1, .slope = -2}});
  EXPECT_DOUBLE_EQ(f.integral(), 0.25);
  EXPECT_EQ(f.integral(0.6, 0.9), 0);
  EXPECT_EQ(f.knots().size(), 3u);
  EXPECT_NEAR(f.knots()[1], 0.5, 1e-15);
}

TEST(CanonicalFunction, CubicsBeginWhereTheirStretchBegins) {
  // On [1, 3]: 2 + u (3 - 4 u + u^2) with u = x - 1; its slope is 0 at u = (4 - sqrt 7) / 3.
  const CanonicalFunction f(
      {"cubic", "", "test"},
      {{.end = 1, .constant = 0.25}, {.end = 3, .constant = 2, .slope = 3, .square = -4, .cube = 1}});
  EXPECT_DOUBLE_EQ(f(1.5), 2 + 0.5 * (3 - 2 + 0.25));
  EXPECT_DOUBLE_EQ(f.integral(), 0.25 + 10 / 3.);
  EXPECT_DOUBLE_EQ(f.integral(1.5, 2), 1 + 3 / 2. * 0.75 - 4 / 3. * 0.875 + 0.9375 / 4);
  const double turn = (4 - std::sqrt(7)) / 3;
  EXPECT_NEAR(f.range().max, 2 + turn * (3 - 4 * turn + turn * turn), 1e-13);
  EXPECT_GE(f.range(1, 2).max, f(1 + turn));
  EXPECT_TRUE(f.isPiecewisePolynomial());
}

TEST(CanonicalFunction, UnknownNamesAndBrokenStretchesAreRejected) {
  EXPECT_FALSE(findCanonicalFunction("cosin"));
  EXPECT_THROW(CanonicalFunction({"none", "", ""}, {}), std::invalid_argument);
  EXPECT_THROW(CanonicalFunction({"back", "", ""}, {{.end = 1}, {.end = 0.5}}), std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
