// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/gamma.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "fields/canonical_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::runEstimator;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20241122;

/// Regularised lower incomplete gamma function, by its power series; x below some hundreds.
double gammaP(double a, double x) {
  if (!(x > 0)) return 0;
  double term = std::exp(a * std::log(x) - x - std::lgamma(a + 1)), sum = term;
  for (double n = 1; term > 1e-17 * sum || n < x; ++n) sum += term *= x / (a + n);
  return std::min(sum, 1.0);
}

std::vector<double> variates(double shape, int n) {
  Rng rng(kSeed);
  std::vector<double> values;
  for (int i = 0; i < n; ++i) {
    SampleStream stream(rng);
    values.push_back(gammaVariate(shape, stream));
  }
  return values;
}

TEST(GammaVariate, HasTheGammaDistribution) {
  const double shapes[] = {.03, .1, .39, .9, 1, 1.5625, 4, 30, 300};
  for (const double shape : shapes) {
    const auto test =
        test::ksTest(variates(shape, 20000), [&](double x) { return gammaP(shape, shape * x); });
    EXPECT_GT(test.pValue(), test::sidak(test::kMinPValue, std::size(shapes))) << shape << ": " << test;
  }
  // Negative control: 3 % of another shape is seen.
  const auto wrong = test::ksTest(variates(4, 20000), [](double x) { return gammaP(4.4, 4.4 * x); });
  EXPECT_LT(wrong.pValue(), test::kMinPValue) << wrong;
}

TEST(GammaVariate, IsNormalAroundOneForLargeShapes) {
  for (const double shape : {1e10, 1e13, 1e16}) {
    std::vector<double> values = variates(shape, 20000);
    // log x has mean -1 / (2 shape) and deviation 1 / sqrt(shape); doubles around 1 are 2^-53 apart, even at
    // shape 1e16 only 1e-8 of that.
    for (double& x : values) x = std::log(x) * std::sqrt(shape);
    const auto test = test::ksTest(values, [](double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; });
    EXPECT_GT(test.pValue(), test::kMinPValue) << shape << ": " << test;
  }
}

TEST(GammaVariate, HasTheTailsOfTinyShapes) {
  // Pr{x < t} = (shape t)^shape / Gamma(shape + 1) for t -> 0: most variates are below the smallest double.
  constexpr int kN = 50000;
  for (const double shape : {1e-6, 1e-4, 1e-2}) {
    const std::vector<double> values = variates(shape, kN);
    for (const double t : {1e-300, 1e-100, 1e-10}) {
      const double below = std::exp(shape * (std::log(shape) + std::log(t)) - std::lgamma(shape + 1));
      const auto count = std::count_if(values.begin(), values.end(), [&](double x) { return x < t; });
      const double found = static_cast<double>(count) / kN;
      EXPECT_LE(std::abs(found - below), kMaxAbsZ * std::sqrt(below * (1 - below) / kN) + 1. / kN)
          << shape << " " << t;
    }
    for (const double x : values) ASSERT_TRUE(x >= 0 && std::isfinite(x));
  }
}

TEST(GammaVariate, HasMeanOneAndTheVarianceOfItsShape) {
  for (const double shape : {.1, .5, 1., 2., 100., 1e6}) {
    RunningStats value, square;
    for (const double x : variates(shape, 100000)) {
      value.add(x);
      square.add((x - 1) * (x - 1));
    }
    EXPECT_LT(std::abs(zTest(value, 1).z()), kMaxAbsZ) << shape << ": " << zTest(value, 1, kSeed);
    EXPECT_LT(std::abs(zTest(square, 1 / shape).z()), kMaxAbsZ) << shape << ": " << zTest(square, 1 / shape);
  }
}

TEST(GammaVariate, TakesItsNumbersFromAPattern) {
  // In a stratified pattern the mean of 256 variates spreads less than that of independent ones.
  const auto spread = [](PatternKind kind) {
    RunningStats means;
    for (std::uint64_t key = 0; key < 200; ++key) {
      const SamplingPattern pattern(kind, 256, key);
      Rng rng(key);
      double mean = 0;
      for (std::uint32_t i = 0; i < 256; ++i) {
        SampleStream stream(rng, pattern, i);
        mean += gammaVariate(1, stream) / 256;
      }
      means.add(mean);
    }
    return means.variance();
  };
  EXPECT_LT(spread(PatternKind::Hammersley), .5 * spread(PatternKind::Independent));
}

/// Exact mean of exp(-gamma x): the law itself.
TEST(Gamma, HasTheMomentsOfRegularTracking) {
  const auto function = *findCanonicalFunction("linear-up");
  const CanonicalLine line(function, {});
  for (const double c : {0., .3, .8, 1.5}) {
    const PinkNoiseLaw law{c};
    const Gamma gamma{.law = law, .base = RegularTracking{}};
    for (const double sigma : {.1, 2., 20.}) {
      RunningStats value, square;
      Rng rng(kSeed);
      for (int i = 0; i < 20000; ++i) {
        const double t = runEstimator(gamma, line, Channels<1>{sigma}, rng).value[0];
        value.add(t);
        square.add(t * t);
      }
      if (c > 0) {
        EXPECT_LT(std::abs(zTest(value, law(sigma)).z()), kMaxAbsZ) << zTest(value, law(sigma), kSeed);
        EXPECT_LT(std::abs(zTest(square, law(2 * sigma)).z()), kMaxAbsZ)
            << zTest(square, law(2 * sigma), kSeed);
      } else {
        EXPECT_NEAR(value.mean(), std::exp(-sigma), 1e-7 * sigma);
        EXPECT_NEAR(value.variance(), 0, 1e-20);
      }
    }
  }
}

TEST(Gamma, HasTheClosedSecondMomentWithRatioTracking) {
  // (1 + C^2 (2 tau - integral of mu^2 / majorant))^(-1/C^2), for bounds and for controls below.
  const auto function = *findCanonicalFunction("linear-up");
  for (const double control : {.8, 1., 3.}) {
    const CanonicalLine line(function, {.control = control});
    const double squares = (4. / 3) / (2 * control);  // of 2x, over the bound 2 * control
    for (const double c : {.4, .8}) {
      for (const double sigma : {.5, 3.}) {
        const PinkNoiseLaw law{c};
        RunningStats value, square;
        Rng rng(kSeed);
        const Gamma gamma{.law = law, .base = RatioTracking{}};
        for (int i = 0; i < 50000; ++i) {
          const double t = runEstimator(gamma, line, Channels<1>{sigma}, rng).value[0];
          value.add(t);
          square.add(t * t);
        }
        EXPECT_LT(std::abs(zTest(value, law(sigma)).z()), kMaxAbsZ) << zTest(value, law(sigma), kSeed);
        const auto second = zTest(square, law(sigma * (2 - squares)), kSeed);
        EXPECT_LT(std::abs(second.z()), kMaxAbsZ) << "control " << control << ", C " << c << ": " << second;
      }
    }
  }
}

TEST(Gamma, HasTheVarianceAndTheCostOfTheReferenceOnTheSine) {
  // Experiments of Misso et al. 2022: C = 0.8, T = 0.5, bound twice the mean: mse 0.187 at 1.746 look-ups.
  const PinkNoiseLaw law{.8};
  const double sigma = (std::pow(.5, -.64) - 1) / .64, squares = 1.5 * sigma / 2;
  EXPECT_NEAR(law(sigma), .5, 1e-12);
  const double variance = law(2 * sigma - squares) - .25;
  EXPECT_NEAR(variance, .187, 5e-4);
  const auto function = *findCanonicalFunction("sine");
  const CanonicalLine line(function, {});
  const Gamma gamma{.law = law, .base = RatioTracking{}};
  RunningStats square, cost;
  Rng rng(kSeed);
  for (int i = 0; i < 50000; ++i) {
    const auto estimate = runEstimator(gamma, line, Channels<1>{sigma}, rng);
    square.add((estimate.value[0] - .5) * (estimate.value[0] - .5));
    cost.add(static_cast<double>(estimate.tally.lookups));
  }
  EXPECT_LT(std::abs(zTest(square, variance).z()), kMaxAbsZ) << zTest(square, variance, kSeed);
  // The reference is the mean of 2e6 runs, of variance E[gamma] 2 sigma + Var[gamma] (2 sigma)^2 each.
  EXPECT_NEAR(2 * sigma, 1.746, kMaxAbsZ * std::sqrt((2 * sigma + .64 * 4 * sigma * sigma) / 2e6));
  EXPECT_LT(std::abs(zTest(cost, 2 * sigma).z()), kMaxAbsZ) << zTest(cost, 2 * sigma, kSeed);
}

TEST(Gamma, SaysThatLowControlsCanMakeTheVarianceInfinite) {
  EXPECT_TRUE((Gamma{.base = RatioTracking{}}.traits().finiteVariance));
  EXPECT_FALSE((Gamma{.base = RatioTracking{}}.traits().finiteVarianceUnbounded));
  EXPECT_TRUE((Gamma{.base = RegularTracking{}}.traits().finiteVarianceUnbounded));
  // Constant medium, control a fifth of it: bracket 1 + C^2 tau (2 - 5) < 0. Given gamma, E[T^2] = e^{3 gamma
  // tau}, and its mean over gamma grows with the largest gamma allowed instead of settling.
  const double c2 = .64, tau = 2;
  const auto momentUpTo = [&](double most) {
    double sum = 0;
    constexpr int kN = 100000;
    for (int i = 0; i < kN; ++i) {
      const double x = (i + .5) / kN * most;
      sum += std::exp(3 * x * tau + (1 / c2 - 1) * std::log(x) - x / c2 - std::log(c2) / c2 -
                      std::lgamma(1 / c2)) *
             most / kN;
    }
    return sum;
  };
  EXPECT_GT(momentUpTo(20), 1e20);
  EXPECT_LT(1 + c2 * (2 * tau - 5 * tau), 0);
}

TEST(Gamma, SharesOneFactorAmongChannels) {
  const auto function = *findCanonicalFunction("constant");
  const CanonicalLine line(function, {});
  Rng rng(kSeed);
  const Gamma gamma{.law = {.8}, .base = RegularTracking{}};
  for (int i = 0; i < 100; ++i) {
    const auto t = runEstimator(gamma, line, Channels<3>{.5, 1, 2}, rng).value;
    EXPECT_NEAR(t[0] * t[0], t[1], 1e-12);
    EXPECT_NEAR(t[1] * t[1], t[2], 1e-12);
  }
}

TEST(Gamma, TakesEveryExponentialEstimatorForItsBase) {
  AnyEstimator estimator = Gamma{};
  for (const std::string_view name : alternativeNames<AnyExponentialEstimator>()) {
    const AssignResult set = setParameter(estimator, "base", std::string(name));
    ASSERT_TRUE(set.known && !set.error) << name;
    const auto described = parametersOf(estimator);
    const AnyEstimator alone = *findEstimator(name);
    const auto own = parametersOf(alone);
    ASSERT_EQ(described.size(), own.size() + 1) << name;
    EXPECT_EQ(described[0].name, "base");
    EXPECT_EQ(described[0].value, name);
    for (std::size_t i = 0; i < own.size(); ++i) {
      EXPECT_EQ(described[i + 1].name, own[i].name);
      EXPECT_EQ(described[i + 1].value, own[i].value);
    }
    EXPECT_EQ(traitsOf(estimator).bias, traitsOf(alone).bias) << name;
    EXPECT_EQ(traitsOf(estimator).laws, LawSet::pinkNoise());
    EXPECT_EQ(lawOf(estimator).index(), AnyLaw(PinkNoiseLaw{}).index());
  }
}

TEST(Gamma, PassesParametersToItsBaseAndRefusesUnknownBases) {
  AnyEstimator estimator = Gamma{};
  EXPECT_FALSE(setParameter(estimator, "roulettethreshold", .25).error);
  EXPECT_EQ(std::get<RatioTracking>(std::get<Gamma>(estimator.held().variant).base).rouletteThreshold, .25);
  EXPECT_FALSE(setParameter(estimator, "rate", .7).known);
  EXPECT_FALSE(setParameter(estimator, "base", std::string("debiased-ray-marching")).error);
  EXPECT_FALSE(setParameter(estimator, "rate", .7).error);
  EXPECT_EQ(std::get<DebiasedRayMarching>(std::get<Gamma>(estimator.held().variant).base).rate, .7);
  EXPECT_TRUE(setParameter(estimator, "rate", .3).error);
  const AssignResult wrong = setParameter(estimator, "base", std::string("gamma"));
  ASSERT_TRUE(wrong.known && wrong.error);
  EXPECT_NE(wrong.error->find("found \"gamma\", expected one of ratio"), std::string::npos) << *wrong.error;
  const AssignResult number = setParameter(estimator, "base", 3.0);
  ASSERT_TRUE(number.known && number.error);
  EXPECT_NE(number.error->find("found 3"), std::string::npos) << *number.error;
  EXPECT_TRUE(setLaw(estimator, PinkNoiseLaw{.8}));
  EXPECT_EQ(std::get<Gamma>(estimator.held().variant).law.correlation, .8);
  EXPECT_FALSE(setLaw(estimator, DavisLaw{}));
  EXPECT_FALSE(setLaw(estimator, ExponentialLaw{}));
}

}  // namespace
}  // namespace pbrtmedia
