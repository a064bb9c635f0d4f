// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/unbiased_ray_marching.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/contract_line.h"
#include "support/function_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::ContractLine;
using test::FunctionLine;
using test::kMaxAbsZ;
using test::runEstimator;
using test::RunningStats;

constexpr std::uint64_t kSeed = 20241122;
constexpr Comb kCombs[] = {Comb::Equidistant, Comb::Stratified, Comb::Independent, Comb::GoldenRatio};

TEST(UnbiasedRayMarching, HasNoVarianceInAConstantMediumOfAnyThickness) {
  const FunctionLine line{[](double) { return .75; }, {{1, {1.5f, 0}}}};
  Rng rng(kSeed);
  for (const double sigma : {1e-300, 1e-8, .1, 1., 20., 400.}) {
    const double truth = std::exp(-.75 * sigma);
    for (const Comb comb : kCombs) {
      for (int i = 0; i < 200; ++i) {
        const double t =
            runEstimator(UnbiasedRayMarching{.comb = comb}, line, Channels<1>{sigma}, rng).value[0];
        EXPECT_NEAR(t, truth, 4 * 0x1p-53 * truth) << sigma;
        EXPECT_NEAR(1 - t, -std::expm1(-.75 * sigma), 4 * 0x1p-53) << sigma;
      }
    }
  }
  for (const double sigma : {1e4, 1e6}) {
    EXPECT_EQ(runEstimator(UnbiasedRayMarching(), line, Channels<1>{sigma}, rng).value[0], 0.0);
  }
  EXPECT_EQ(runEstimator(UnbiasedRayMarching(), line, Channels<1>{0}, rng).tally.lookups, 0u);
}

TEST(UnbiasedRayMarching, MarchesWithOneToothWhereMinorantAndMajorantMeet) {
  const FunctionLine line{[](double) { return .75; }, {{1, {.75f, .75f}}}};
  Rng rng(kSeed);
  for (const double sigma : {1., 1e4, 1e9}) {
    for (int i = 0; i < 100; ++i) {
      const auto estimate = runEstimator(UnbiasedRayMarching(), line, Channels<1>{sigma}, rng);
      EXPECT_NEAR(estimate.value[0], std::exp(-.75 * sigma), 1e-15);
      EXPECT_LE(estimate.tally.lookups, 40u);  // N + 1 combs of one tooth
    }
  }
}

TEST(UnbiasedRayMarching, IsExactInALinearMediumWithMatchedEnds) {
  const FunctionLine line{[](double s) { return 2 - 1.5 * s; }, {{1, {2, .5f}}}};
  Rng rng(kSeed);
  for (const Comb comb : kCombs) {
    for (const std::uint64_t teeth : {1u, 2u, 3u, 8u, 40u}) {
      const UnbiasedRayMarching estimator{
          .comb = comb, .endpointMatching = EndpointMatching::On, .tupleSize = teeth};
      for (const double sigma : {.1, 1., 4.}) {
        const double tau = 1.25 * sigma;
        for (int i = 0; i < 50; ++i) {
          EXPECT_NEAR(runEstimator(estimator, line, Channels<1>{sigma}, rng).value[0], std::exp(-tau),
                      std::exp(-tau) * tau * 0x1p-21);
        }
      }
    }
  }
}

TEST(UnbiasedRayMarching, FindsDensityWhereAnUnprovenBoundIsZero) {
  const FunctionLine line{[](double s) { return 1 + s; }, {{.5, {0, 0, 0}}, {1, {0, 0, 0}}}};
  std::uint64_t violations = 0;
  const auto test = test::runZTest(
      [&](Rng& rng) {
        const auto estimate = runEstimator(UnbiasedRayMarching(), line, Channels<1>{1}, rng);
        violations += estimate.tally.violations;
        EXPECT_EQ(estimate.tally.violations, estimate.tally.lookups);
        return estimate.value[0];
      },
      std::exp(-1.5), kSeed, 200000);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_GT(violations, 0u);
}

TEST(UnbiasedRayMarching, CostsWhatPSeriesCmfDoes) {
  const FunctionLine line{[](double s) { return 1 + std::cos(9 * s); }, {{1, {2, 0}}}};
  for (const double sigma : {.25, 2., 20.}) {
    const double control = 2 * sigma, expected = OrderRoulette::aggressive(2, .9).expectedOrder();
    const auto teeth = static_cast<double>(tupleSizeFor(control, expected, 0));
    const auto test = test::runZTest(
        [&](Rng& rng) {
          return runEstimator(UnbiasedRayMarching(), line, Channels<1>{sigma}, rng).tally.lookups;
        },
        teeth * (1 + expected) + (teeth >= 8 ? 2 : 0), kSeed, 100000);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
    EXPECT_NEAR(test.truth, pSeriesCmfLookups(control), 3);
  }
}

TEST(UnbiasedRayMarching, LooksUpNothingAtOrderZeroOfAGivenPivot) {
  const FunctionLine line{[](double s) { return s; }, {{1, {1, 0}}}};
  Rng rng(kSeed);
  int withoutLookup = 0;
  for (int i = 0; i < 10000; ++i) {
    const UnbiasedRayMarching estimator{.pivot = Pivot::Fixed, .pivotDepth = .7};
    const auto estimate = runEstimator(estimator, line, Channels<1>{2}, rng);
    if (estimate.tally.lookups > 0) continue;
    ++withoutLookup;
    EXPECT_NEAR(estimate.value[0], std::exp(-.7), 1e-15);
  }
  EXPECT_NEAR(withoutLookup, 9000, 5 * 30);
}

TEST(UnbiasedRayMarching, StaysWithinItsLimitAndUnbiased) {
  const FunctionLine line{[](double s) { return 1 + std::cos(20 * s); }, {{1, {200, 0}}}};
  const UnbiasedRayMarching estimator{.maxLookups = 5};
  const auto test = test::runZTest(
      [&](Rng& rng) {
        const auto estimate = runEstimator(estimator, line, Channels<1>{1}, rng);
        EXPECT_EQ(estimate.tally.lookups % 5, 0u);
        return estimate.value[0];
      },
      std::exp(-1 - std::sin(20.) / 20), kSeed, 100000);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST(UnbiasedRayMarching, MarchesAMillionTeethInBoundedMemory) {
  const FunctionLine line{[](double s) { return s < .5 ? 0. : 2.; }, {{1, {2, 0}}}};
  Rng rng(kSeed);
  const auto estimate = runEstimator(UnbiasedRayMarching{.tupleSize = 1000000}, line, Channels<1>{1}, rng);
  EXPECT_NEAR(estimate.value[0], std::exp(-1.), 1e-5);
  EXPECT_EQ(estimate.tally.lookups % 1000000, 2u);
  const auto thick = runEstimator(UnbiasedRayMarching(), line, Channels<1>{1e6}, rng);
  EXPECT_EQ(thick.value[0], 0.0);
}

TEST(UnbiasedRayMarching, GivesEveryChannelItsOwnSeriesFromTheSameLookups) {
  const Channels<3> sigma{0, .4, 3};
  for (const bool isSymmetrised : {true, false}) {
    for (const Pivot pivot : {Pivot::Sampled, Pivot::Fixed, Pivot::Majorant}) {
      const UnbiasedRayMarching estimator{.pivot = pivot,
                                          .symmetrisation = isSymmetrised,
                                          .roulette = Roulette::BhanotKennedy,
                                          .expansion = 4};
      Rng rng(kSeed);
      RunningStats values[3];
      for (int i = 0; i < 30000; ++i) {
        const ContractLine line;
        const auto estimate = runEstimator(estimator, line, sigma, rng);
        ASSERT_EQ(estimate.tally.lookups, line.asked());
        for (std::size_t c = 0; c < 3; ++c) values[c].add(estimate.value[c]);
      }
      for (std::size_t c = 0; c < 3; ++c) {
        const auto test = test::zTest(values[c], std::exp(-sigma[c] * ContractLine::integral()), kSeed);
        EXPECT_LT(std::abs(test.z()), kMaxAbsZ)
            << "pivot " << static_cast<int>(pivot) << ", channel " << c << ": " << test;
      }
      EXPECT_EQ(values[0].variance(), 0.0);
    }
  }
}

TEST(UnbiasedRayMarching, TakesPlainProductsWhereMeansWouldTakeMinutes) {
  // 5000 orders about a sampled pivot: N^3 operations would not end.
  const FunctionLine line{[](double s) { return 1 + .5 * std::cos(20 * s); }, {{1, {2, 0}}}};
  const UnbiasedRayMarching estimator{.roulette = Roulette::BhanotKennedy, .expansion = 5000, .tupleSize = 1};
  Rng rng(kSeed);
  const double truth = std::exp(-1 - .5 * std::sin(20.) / 20);
  RunningStats values;
  for (int i = 0; i < 300; ++i) {
    const auto estimate = runEstimator(estimator, line, Channels<1>{1}, rng);
    EXPECT_GT(estimate.tally.lookups, 5000u);
    values.add(estimate.value[0]);
  }
  const auto test = test::zTest(values, truth, kSeed);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST(UnbiasedRayMarching, SaysWhatItsParametersMakeOfIt) {
  UnbiasedRayMarching estimator;
  EXPECT_EQ(estimator.traits().bias, EstimatorTraits::Bias::Unbiased);
  EXPECT_EQ(estimator.traits().control, EstimatorTraits::Control::CostOnly);
  const auto set = [&](std::string_view name, const ParameterValue& value) {
    const AssignResult result = assignParameter(estimator, name, value);
    EXPECT_TRUE(result.known && !result.error) << name << result.error.value_or("");
  };
  set("comb", std::string("goldenratio"));
  set("endpointmatching", std::string("on"));
  set("symmetrisation", false);
  set("zeroorderprobability", .5);
  set("expansion", 3.);
  set("tuplesize", 4.);
  set("warp", std::string("off"));
  set("maxlookups", 100.);
  EXPECT_EQ(estimator.comb, Comb::GoldenRatio);
  EXPECT_EQ(estimator.tupleSize, 4u);
  set("pivot", std::string("majorant"));
  EXPECT_EQ(estimator.traits().control, EstimatorTraits::Control::Any);
  set("roulette", std::string("none"));
  EXPECT_EQ(estimator.traits().bias, EstimatorTraits::Bias::Consistent);
  EXPECT_TRUE(assignParameter(estimator, "zeroorderprobability", 1.).error);
  EXPECT_TRUE(assignParameter(estimator, "roulette", std::string("russian")).error);
}

}  // namespace
}  // namespace pbrtmedia
