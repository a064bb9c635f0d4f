// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "support/contract_line.h"
#include "support/function_line.h"
#include "support/run_estimator.h"
#include "transmittance/estimators/regular_tracking.h"

namespace pbrtmedia {
namespace {

using test::simpson;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
const std::vector<double> kLadder{0,  1e-308, 1e-300, 1e-100, 1e-16, 1e-8, 1e-3,  .1,    .5,    1,        2,
                                  10, 100,    745,    1e3,    1e6,   1e16, 1e100, 1e300, 1e308, kInfinite};

std::vector<AnyLaw> manyLaws() {
  std::vector<AnyLaw> laws{ExponentialLaw{},      LinearLaw{},         LinearLaw{1e-6},
                           LinearLaw{1e6},        MixtureLaw{},        MixtureLaw{1, 0, 1e6},
                           MixtureLaw{.25, 0, 3}, MixtureLaw{0, 5, .1}};
  for (const double c : {0., 1e-200, 1e-160, 1e-8, 1e-3, .3, .5, .8, 1., 2., 1e3}) {
    laws.push_back(PinkNoiseLaw{c});
    for (const double beta : {0., .01, .5, .99, 1.}) laws.push_back(DavisLaw{c, beta});
  }
  return laws;
}

TEST(Law, StartsAtOneAndFallsWithinTheUnitIntervalOverTheWholeLadder) {
  for (const AnyLaw& law : manyLaws()) {
    EXPECT_EQ(transmittanceOf(law, 0), 1.0) << nameOf(law);
    double before = 1;
    for (const double depth : kLadder) {
      const double g = transmittanceOf(law, depth);
      EXPECT_TRUE(g >= 0 && g <= 1) << nameOf(law) << " at " << depth << ": " << g;
      EXPECT_LE(g, before * (1 + 1e-12)) << nameOf(law) << " at " << depth;
      before = g;
    }
  }
}

TEST(Law, HasTheDensityThatItsFallIs) {
  for (const AnyLaw& law : manyLaws()) {
    for (const double depth : {1e-3, .1, .7, 3., 20.}) {
      // Central differences; the linear law has a kink at its extent.
      const double h = 1e-4 * depth;
      const auto* linear = std::get_if<LinearLaw>(&law);
      if (linear && std::abs(depth - linear->extent) < 2 * h) continue;
      const double slope = (transmittanceOf(law, depth - h) - transmittanceOf(law, depth + h)) / (2 * h);
      EXPECT_NEAR(collisionDensityOf(law, depth), slope, 1e-6 * std::abs(slope) + 1e-9 / depth)
          << nameOf(law) << " at " << depth;
    }
    EXPECT_EQ(collisionDensityOf(law, kInfinite), 0) << nameOf(law);
    for (const double depth : kLadder) {
      const double density = collisionDensityOf(law, depth);
      EXPECT_TRUE(density >= 0 && std::isfinite(density))
          << nameOf(law) << " at " << depth << ": " << density;
    }
  }
}

TEST(Law, IsReachedAtTheDepthOfAFlight) {
  for (const AnyLaw& law : manyLaws()) {
    EXPECT_EQ(depthReachedOf(law, 1), 0) << nameOf(law);
    for (const double u : {1e-12, 1e-3, .2, .5, .9, .999}) {
      const double depth = depthReachedOf(law, u);
      ASSERT_TRUE(depth >= 0) << nameOf(law) << " at " << u;
      if (std::isinf(depth)) {
        // A part of the light that nothing dims, or a law that falls too slowly for numbers.
        EXPECT_GE(transmittanceOf(law, 1e308), u * (1 - 1e-9)) << nameOf(law);
      } else {
        EXPECT_NEAR(transmittanceOf(law, depth), u, 1e-9 * u + 1e-15) << nameOf(law) << " at " << u;
      }
    }
  }
}

TEST(Law, AnswersNegativeDepthsOfCorrectedQuadrature) {
  EXPECT_EQ(transmittanceOf(ExponentialLaw{}, -.5), std::exp(.5));
  for (const AnyLaw& law : manyLaws()) {
    if (!std::holds_alternative<ExponentialLaw>(law)) {
      EXPECT_EQ(transmittanceOf(law, -1e-3), 1.0);
    }
  }
}

TEST(Law, HasTheClosedFormsOfItsFormula) {
  for (const double f : {1e-3, .1, 1., 7., 200.}) {
    const auto wide = static_cast<long double>(f);
    for (const double c : {1e-6, 1e-3, .3, .8, 1.5, 30., 1e3}) {
      const long double c2 = static_cast<long double>(c) * c;
      const double pink = static_cast<double>(std::exp(-std::log1p(c2 * wide) / c2));
      EXPECT_NEAR(PinkNoiseLaw{c}(f) / pink, 1, 1e-13 * (1 + f)) << c << " " << f;
      for (const double beta : {0., .25, .7, 1.}) {
        const long double cb = std::pow(static_cast<long double>(c), 1 + static_cast<long double>(beta));
        const long double y = std::pow(wide, static_cast<long double>(beta)) * cb;
        const double davis = static_cast<double>(
            std::exp(-std::log1p(y) * std::pow(wide, 1 - static_cast<long double>(beta)) / cb));
        EXPECT_NEAR(DavisLaw({c, beta})(f) / davis, 1, 1e-13 * (1 + f)) << c << " " << beta << " " << f;
      }
    }
    EXPECT_DOUBLE_EQ(LinearLaw{500}(f), 1 - f / 500);
    EXPECT_DOUBLE_EQ(MixtureLaw({.3, .5, 2})(f), .3 * std::exp(-.5 * f) + .7 * std::exp(-2 * f));
  }
  EXPECT_DOUBLE_EQ(PinkNoiseLaw{1}(3), .25);    // 1 / (1 + F)
  EXPECT_DOUBLE_EQ(DavisLaw({1, 0})(3), .125);  // 2^-F
}

TEST(Law, KeepsTheSmallLossOfThinMedia) {
  for (const double f : {1e-15, 1e-12, 1e-8}) {
    for (const double c : {0., .5, 1.}) {
      EXPECT_NEAR(1 - PinkNoiseLaw{c}(f), f, 2e-16 + f * f);
      EXPECT_NEAR(1 - DavisLaw({c, .9})(f), f, 2e-16 + 2 * std::pow(f, 1.9));
    }
  }
}

TEST(Law, IsPinkNoiseForDavisWithBetaOneAndExponentialInTheLimit) {
  for (const double f : kLadder) {
    for (const double c : {0., 1e-200, 1e-160, 1e-8, .01, .5, .8, 3., 1e3}) {
      const double pink = PinkNoiseLaw{c}(f);
      EXPECT_NEAR(DavisLaw({c, 1})(f), pink, 1e-12 * pink) << c << " " << f;
    }
    for (const double c : {0., 1e-200, 1e-160, 1e-18}) {
      const double exponential = std::exp(-f);
      EXPECT_NEAR(PinkNoiseLaw{c}(f), exponential, 1e-12 * exponential) << c << " " << f;
      for (const double beta : {0., .5, 1.}) {
        EXPECT_NEAR(DavisLaw({c, beta})(f), exponential, 1e-12 * exponential) << c << " " << f;
      }
    }
  }
}

TEST(Law, KnowsPinkNoiseWhereOneOfItsPartsOverflows) {
  // (1e6 * 1e308)^(-1e-6)
  EXPECT_NEAR(PinkNoiseLaw{1e3}(1e308), std::exp(-314 * std::numbers::ln10 * 1e-6), 1e-12);
  EXPECT_NEAR(DavisLaw({1e3, 1})(1e308), std::exp(-314 * std::numbers::ln10 * 1e-6), 1e-12);
}

TEST(Law, IsTheMeanOfExponentialsOverGammaForPinkNoise) {
  for (const double c : {.3, .5, .8, 1., 2.}) {
    const double shape = 1 / (c * c);
    for (const double f : {.1, 1., 6.}) {
      // The density of log gamma times exp(-gamma F), gamma ~ Gamma(shape, scale 1 / shape).
      const auto integrand = [&](double t) {
        return std::exp(shape * t - std::exp(t) * (shape + f) + shape * std::log(shape) - std::lgamma(shape));
      };
      EXPECT_NEAR(simpson(integrand, -40 / shape - 10, 6), PinkNoiseLaw{c}(f), 1e-9) << c << " " << f;
    }
  }
}

/// Taylor coefficients by Cauchy's integral on a circle, which converges exponentially.
double taylorByCauchy(const PinkNoiseLaw& law, double depth, int order) {
  const double c2 = law.correlation * law.correlation, radius = .5 * (depth + 1 / c2);
  constexpr int kPoints = 256;
  std::complex<double> sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPoints;
    const std::complex<double> z = depth + std::polar(radius, angle);
    sum += std::pow(1.0 + c2 * z, -1 / c2) * std::polar(1.0, -angle * order);
  }
  return sum.real() / kPoints / std::pow(radius, order);
}

TEST(PinkNoiseLaw, HasTheTaylorCoefficientsOfCauchysIntegral) {
  for (const double c : {.3, .5, .8, 1., 1.4}) {
    const PinkNoiseLaw law{c};
    for (const double depth : {0., .5, 3., 12.}) {
      double coefficient = law(depth);
      for (int k = 1; k <= 30; ++k) {
        coefficient *= law.taylorRatio(depth, k);
        const double scale = law(depth) / std::pow(.5 * (depth + 1 / (c * c)), k);
        EXPECT_NEAR(coefficient, taylorByCauchy(law, depth, k), 1e-8 * (std::abs(coefficient) + scale))
            << "C " << c << ", F " << depth << ", order " << k;
      }
    }
  }
}

TEST(PinkNoiseLaw, IsTheSumOfItsTaylorSeriesInsideTheRangeAndNotOutside) {
  const auto sumAt = [](const PinkNoiseLaw& law, double pivot, double depth) {
    double term = law(pivot), sum = term;
    for (int k = 1; k < 2000; ++k) sum += term *= law.taylorRatio(pivot, k) * (depth - pivot);
    return sum;
  };
  for (const double c : {0., .5, .8, 1., 1.3}) {
    const PinkNoiseLaw law{c};
    for (const double pivot : {.5, 2., 8.}) {
      const double end = c > 0 ? 2 * pivot + 1 / (c * c) : 3 * pivot;  // here the series stops converging
      for (const double share : {.01, .3, .9}) {
        EXPECT_NEAR(sumAt(law, pivot, share * end), law(share * end), 1e-9) << c << " " << pivot;
      }
      if (c > 0) {
        EXPECT_GT(std::abs(sumAt(law, pivot, 1.1 * end)), 1e6) << c << " " << pivot;
      }
    }
  }
}

TEST(PinkNoiseLaw, AlternatesTheSignsOfItsDerivatives) {
  const PinkNoiseLaw law{.8};
  for (int k = 1; k < 20; ++k) EXPECT_LT(law.taylorRatio(2, k), 0);
  EXPECT_DOUBLE_EQ(law.taylorRatio(0, 1), -1);  // g'(0) = -1
}

TEST(Law, IsWhatRegularTrackingAppliesToTheExactDepth) {
  Rng rng(1);
  const test::ContractLine line;
  for (const AnyLaw& law : manyLaws()) {
    for (const double sigma : {1e-6, .3, 2., 20.}) {
      const auto estimate = test::runEstimator(RegularTracking{law}, line, Channels<1>{sigma}, rng);
      const double depth = sigma * test::ContractLine::integral();
      EXPECT_NEAR(estimate.value[0], transmittanceOf(law, depth), 1e-6) << nameOf(law) << " at " << depth;
    }
  }
}

TEST(Law, IsFoundByNameAndRefusesWhatItCannotBe) {
  for (const std::string_view name : lawNames()) EXPECT_EQ(nameOf(*findLaw(name)), name);
  EXPECT_FALSE(findLaw("pink"));
  AnyLaw law = *findLaw("davis");
  EXPECT_FALSE(setParameter(law, "beta", .5).error);
  EXPECT_FALSE(setParameter(law, "correlation", 0.0).error);
  EXPECT_TRUE(setParameter(law, "beta", 1.5).error);
  EXPECT_TRUE(setParameter(law, "correlation", -.1).error);
  EXPECT_TRUE(setParameter(law, "correlation", kInfinite).error);
  EXPECT_FALSE(setParameter(law, "extent", 1.0).known);
}

TEST(LawSet, NamesTheLawsItHolds) {
  EXPECT_EQ(LawSet::all().names(), lawNames());
  EXPECT_EQ(LawSet::exponential().names(), std::vector<std::string_view>{"exponential"});
  EXPECT_EQ(LawSet::pinkNoise().names(), std::vector<std::string_view>{"pinknoise"});
  EXPECT_TRUE(LawSet::all().has(MixtureLaw{}));
  EXPECT_FALSE(LawSet::pinkNoise().has(DavisLaw{}));
}

}  // namespace
}  // namespace pbrtmedia
