// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/bhanot_kennedy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "support/function_line.h"
#include "support/roulette_moments.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimators/p_series_cmf.h"
#include "transmittance/estimators/p_series_cumulative.h"
#include "transmittance/estimators/u_bk.h"

namespace pbrtmedia {
namespace {

using test::FunctionLine;
using test::kMaxAbsZ;
using test::RouletteMoments;
using test::runEstimator;
using test::RunningStats;

constexpr std::uint64_t kSeed = 20241122;

FunctionLine cosine(float bound) {
  return {[](double s) { return 1 + std::cos(20 * s + .8); }, {{1, {bound, 0}}}};
}
/// Mean and variance of one look-up's estimate of the integral.
struct LookupMoments {
  double mean, variance;

  explicit LookupMoments(const FunctionLine& line)
      : mean(test::simpson(line.function, 0, 1)),
        variance(test::simpson([&](double s) { return line.function(s) * line.function(s); }, 0, 1) -
                 mean * mean) {}
};

/// Estimates and their squares.
struct Moments {
  RunningStats value, square, lookups;

  template <class Estimator>
  Moments(const Estimator& estimator, const FunctionLine& line, double sigma, int n,
          std::uint64_t seed = kSeed) {
    Rng rng(seed);
    for (int i = 0; i < n; ++i) {
      const auto estimate = runEstimator(estimator, line, Channels<1>{sigma}, rng);
      value.add(estimate.value[0]);
      square.add(estimate.value[0] * estimate.value[0]);
      lookups.add(static_cast<double>(estimate.tally.lookups));
    }
  }
};

void expectZ(const RunningStats& values, double truth, const std::string& what) {
  const auto test = test::zTest(values, truth, kSeed);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << what << ": " << test;
}

TEST(BhanotKennedy, HasTheExactMeanVarianceAndCost) {
  const FunctionLine line = cosine(2);
  const LookupMoments lookup(line);
  for (const double c : {1., 2., 4.}) {
    for (const double sigma : {.3, 1.}) {
      for (const bool givenTruth : {false, true}) {
        const double pivotDepth = givenTruth ? lookup.mean * sigma : 2 * sigma;
        const BhanotKennedy estimator{
            .pivot = givenTruth ? Pivot::Fixed : Pivot::Majorant, .pivotDepth = pivotDepth, .expansion = c};
        const OrderRoulette roulette = OrderRoulette::bhanotKennedy(c);
        const double m = pivotDepth - lookup.mean * sigma, variance = lookup.variance * sigma * sigma;
        const double second =
            std::exp(-2 * pivotDepth) * RouletteMoments(roulette).productSecondMoment(m, variance);
        const Moments run(estimator, line, sigma, 150000);
        const std::string what = "c " + std::to_string(c) + ", sigma " + std::to_string(sigma);
        expectZ(run.value, std::exp(-lookup.mean * sigma), what);
        expectZ(run.square, second, what + ", squares");
        expectZ(run.lookups, roulette.expectedOrder(), what + ", look-ups");
      }
    }
  }
}

TEST(UBk, HasTheExactMeanVarianceAndCost) {
  const FunctionLine line = cosine(2);
  const LookupMoments lookup(line);
  for (const double c : {1., 2., 4.}) {
    for (const bool givenTruth : {false, true}) {
      const double pivotDepth = givenTruth ? lookup.mean : 2;
      const UBk estimator{.pivot = givenTruth ? Pivot::Fixed : Pivot::Majorant,
                          .pivotDepth = pivotDepth,
                          .expansion = c,
                          .tupleSize = 1};
      const OrderRoulette roulette = OrderRoulette::bhanotKennedy(c);
      const RouletteMoments moments(roulette, 40);
      const double second = std::exp(-2 * pivotDepth) *
                            moments.symmetricSecondMoment(pivotDepth - lookup.mean, lookup.variance);
      const Moments run(estimator, line, 1, 150000);
      const std::string what = "c " + std::to_string(c);
      expectZ(run.value, std::exp(-lookup.mean), what);
      expectZ(run.square, second, what + ", squares");
      expectZ(run.lookups, roulette.expectedOrder(), what + ", look-ups");
    }
  }
}

TEST(UBk, AveragesOverPivotsToo) {
  const FunctionLine line = cosine(2);
  const double truth = std::exp(-LookupMoments(line).mean);
  const Moments sampled(UBk{.tupleSize = 1}, line, 1, 150000);
  expectZ(sampled.value, truth, "sampled pivot");
  expectZ(sampled.lookups, 1 + OrderRoulette::bhanotKennedy(2).expectedOrder(), "combs");
  const Moments plain(BhanotKennedy{.pivot = Pivot::Sampled, .expansion = 2}, line, 1, 150000);
  expectZ(plain.value, truth, "first comb as the pivot, plain products");
  EXPECT_LT(3 * sampled.value.variance(), plain.value.variance());
}

/// P-series CMF is Bhanot-Kennedy with c = the control's depth, the majorant as pivot and K by the CMF: one
/// formula for both.
TEST(BhanotKennedy, WithTheRouletteCmfIsPSeriesCmf) {
  for (const double looseness : {1., 3.}) {
    for (const double sigma : {.5, 2.}) {
      const FunctionLine line = cosine(static_cast<float>(2 * looseness));
      const LookupMoments lookup(line);
      const double depth = 2 * looseness * sigma;
      const OrderRoulette roulette = OrderRoulette::cmf(depth);
      const double second =
          std::exp(-2 * depth) * RouletteMoments(roulette).productSecondMoment(
                                     depth - lookup.mean * sigma, lookup.variance * sigma * sigma);
      const Moments run(BhanotKennedy{.roulette = Roulette::Cmf}, line, sigma, 200000);
      expectZ(run.value, std::exp(-lookup.mean * sigma), "mean");
      expectZ(run.square, second, "squares");
      expectZ(run.lookups, roulette.expectedOrder(), "look-ups");
    }
  }
}

/// Georgiev et al. 2019 (30) in a constant medium: every factor is the same, so the sum after j look-ups is a
/// number, and the walk ends there with a known probability.
TEST(BhanotKennedy, WithTheRouletteCumulativeIsPSeriesCumulative) {
  for (const auto& [tau, depth] : {std::pair{.5, .7}, {1., 3.}, {3., 4.}, {1.5, 1.}}) {
    std::map<int, double> values;  // after j look-ups
    double weight = 1, sum = 1, reached = 1, mean = 0, second = 0, lookups = 0;
    for (int j = 1; j < 200 && reached > 1e-30; ++j) {
      values[j] = std::exp(-depth) * sum;
      lookups += reached;
      weight *= (depth - tau) / j;
      const double go = std::min(std::abs(weight), 1.0);
      mean += reached * (1 - go) * values[j];
      second += reached * (1 - go) * values[j] * values[j];
      reached *= go;
      weight /= go;
      sum += weight;
    }
    EXPECT_NEAR(mean, std::exp(-tau), 1e-12);
    const FunctionLine line{[](double) { return 1.; }, {{1, {static_cast<float>(depth / tau), 0}}}};
    const BhanotKennedy estimator{.roulette = Roulette::Cumulative};
    Rng rng(kSeed);
    for (int i = 0; i < 2000; ++i) {
      const auto estimate = runEstimator(estimator, line, Channels<1>{tau}, rng);
      const double expected = values[static_cast<int>(estimate.tally.lookups)];
      ASSERT_NEAR(estimate.value[0], expected, 1e-6 * std::abs(expected));
    }
    const Moments run(estimator, line, tau, 150000);
    expectZ(run.value, mean, "mean");
    expectZ(run.lookups, lookups, "look-ups");
    if (second > mean * mean * (1 + 1e-9)) expectZ(run.square, second, "squares");
  }
}

/// The estimators of those names are other code: both must have the same moments and cost.
TEST(BhanotKennedy, AgreesWithThePSeriesEstimatorsItContains) {
  const auto compare = [](const Moments& a, const Moments& b, const std::string& what) {
    for (const auto& [x, y] :
         {std::pair{&a.value, &b.value}, {&a.square, &b.square}, {&a.lookups, &b.lookups}}) {
      const auto test = test::zTest(*x, *y, kSeed);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << what << ": " << test;
    }
  };
  for (const float bound : {2.f, 5.f, 1.4f}) {
    for (const double sigma : {.3, 1.5}) {
      const FunctionLine line = cosine(bound);
      std::string what = "bound " + std::to_string(bound);
      what += ", sigma " + std::to_string(sigma);
      compare(Moments(BhanotKennedy{.roulette = Roulette::Cmf}, line, sigma, 100000),
              Moments(PSeriesCmf(), line, sigma, 100000, kSeed + 1), what + ", cmf");
      compare(Moments(BhanotKennedy{.roulette = Roulette::Cumulative}, line, sigma, 100000),
              Moments(PSeriesCumulative(), line, sigma, 100000, kSeed + 1), what + ", cumulative");
    }
  }
}

TEST(BhanotKennedy, FollowsItsControlAtEveryThickness) {
  const FunctionLine line = cosine(2);
  for (const double sigma : {1e-8, .1, 5., 100., 1e4, 1e6}) {
    Rng rng(kSeed);
    for (int i = 0; i < 3; ++i) {
      const auto estimate = runEstimator(BhanotKennedy(), line, Channels<1>{sigma}, rng);
      EXPECT_TRUE(std::isfinite(estimate.value[0])) << sigma;
      EXPECT_LT(static_cast<double>(estimate.tally.lookups), 2 * sigma + 20 * std::sqrt(sigma) + 30);
    }
  }
  expectZ(Moments(BhanotKennedy(), line, 5, 100000).value, std::exp(-5 * LookupMoments(line).mean),
          "sigma 5");
}

TEST(BhanotKennedy, EndsAtItsLimitAndSaysSo) {
  const FunctionLine line = cosine(2);
  Rng rng(kSeed);
  for (int i = 0; i < 100; ++i) {
    const auto estimate =
        runEstimator(BhanotKennedy{.expansion = 20, .maxLookups = 7}, line, Channels<1>{1}, rng);
    EXPECT_EQ(estimate.tally.lookups, 7u);
    EXPECT_EQ(estimate.tally.capped, 1u);
  }
  EXPECT_EQ(BhanotKennedy{.maxLookups = 7}.traits().bias, EstimatorTraits::Bias::Consistent);
}

TEST(BhanotKennedy, WithoutRouletteIsTheTruncatedSeries) {
  const FunctionLine line{[](double) { return 1.; }, {{1, {2, 0}}}};
  Rng rng(kSeed);
  // e^{-2} (1 + 1 + 1/2 + 1/6)
  const auto estimate =
      runEstimator(BhanotKennedy{.roulette = Roulette::None, .expansion = 3}, line, Channels<1>{1}, rng);
  EXPECT_NEAR(estimate.value[0], std::exp(-2.) * (2.5 + 1. / 6), 1e-15);
  EXPECT_EQ(estimate.tally.lookups, 3u);
}

TEST(UBk, NeverFallsBehindBhanotKennedy) {
  for (const float bound : {2.f, 4.f}) {
    const FunctionLine line = cosine(bound);
    for (const double sigma : {.5, 2.}) {
      const Moments u(UBk{.pivot = Pivot::Majorant, .expansion = 0, .tupleSize = 1}, line, sigma, 50000);
      const Moments bk(BhanotKennedy(), line, sigma, 50000);
      EXPECT_LT(u.value.variance(), bk.value.variance()) << bound << ", " << sigma;
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
