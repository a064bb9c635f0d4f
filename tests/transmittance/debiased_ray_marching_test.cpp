// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/debiased_ray_marching.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <vector>

#include "fields/canonical_line.h"
#include "support/contract_line.h"
#include "support/function_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimators/prefix_debiased_ray_marching.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::runEstimator;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20241122;
constexpr Comb kCombs[] = {Comb::Equidistant, Comb::Stratified, Comb::Independent, Comb::GoldenRatio};

/// E[g(one march of `teeth` equidistant teeth)], by quadrature over its offset.
double marchMean(const CanonicalLine& line, std::uint64_t teeth, const AnyLaw& law, double sigma) {
  constexpr int kOffsets = 4000;
  double mean = 0;
  for (int o = 0; o < kOffsets; ++o) {
    double sum = 0;
    for (std::uint64_t j = 0; j < teeth; ++j) {
      sum += line.density((static_cast<double>(j) + (o + .5) / kOffsets) * line.length() /
                          static_cast<double>(teeth));
    }
    mean += transmittanceOf(law, sigma * sum * line.length() / static_cast<double>(teeth)) / kOffsets;
  }
  return mean;
}

TEST(DebiasedRayMarching, IsExactInConstantMediaUnderEveryLaw) {
  const auto function = *findCanonicalFunction("constant");
  const CanonicalLine line(function, {.length = 2, .scale = .75});
  Rng rng(kSeed);
  for (const std::string_view name : lawNames()) {
    const AnyLaw law = *findLaw(name);
    for (const Comb comb : kCombs) {
      for (const double sigma : {1e-8, .5, 4., 1e4, 1e300}) {
        for (int i = 0; i < 20; ++i) {
          const double truth = transmittanceOf(law, 1.5 * sigma);
          for (const bool reuse : {false, true}) {
            const DebiasedRayMarching single{.law = law, .comb = comb, .reuse = reuse};
            EXPECT_NEAR(runEstimator(single, line, Channels<1>{sigma}, rng).value[0], truth, 1e-12);
          }
          const PrefixDebiasedRayMarching prefix{.law = law, .comb = comb};
          EXPECT_NEAR(runEstimator(prefix, line, Channels<1>{sigma}, rng).value[0], truth, 1e-12);
        }
      }
    }
  }
}

TEST(DebiasedRayMarching, DrawsGeometricLevelsAndDoublesItsLookupsWithEach) {
  const auto function = *findCanonicalFunction("cosine");
  const CanonicalLine line(function, {});
  const auto levelsAreGeometric = [&](const auto& estimator, std::uint64_t apart, double rate) {
    constexpr double kRuns = 20000;
    std::map<std::uint64_t, double> counts;
    Rng rng(kSeed);
    for (int i = 0; i < kRuns; ++i)
      ++counts[runEstimator(estimator, line, Channels<1>{1}, rng).tally.lookups];
    double others = kRuns;
    for (int level = 0; level < 4; ++level) {
      const double expected = rate * std::pow(1 - rate, level);
      const double found = counts[(std::uint64_t{6} << (level + 1)) + apart] / kRuns;
      EXPECT_LT(std::abs(found - expected), kMaxAbsZ * std::sqrt(expected * (1 - expected) / kRuns));
      others -= found * kRuns;
    }
    const double beyond = std::pow(1 - rate, 4);
    EXPECT_LT(std::abs(others / kRuns - beyond), kMaxAbsZ * std::sqrt(beyond * (1 - beyond) / kRuns));
    for (const auto& [lookups, count] : counts) {
      const std::uint64_t teeth = lookups - apart;
      EXPECT_TRUE(teeth % 12 == 0 && std::has_single_bit(teeth / 12)) << lookups;
    }
  };
  for (const double rate : {.55, .65, .9}) {
    levelsAreGeometric(DebiasedRayMarching{.n = 3, .levels = 1, .rate = rate}, 0, rate);
    levelsAreGeometric(DebiasedRayMarching{.n = 3, .levels = 1, .rate = rate, .reuse = false}, 6, rate);
    levelsAreGeometric(PrefixDebiasedRayMarching{.n = 3, .levels = 1, .rate = rate}, 0, rate);
  }
}

TEST(DebiasedRayMarching, CostsWhatTheClosedFormSays) {
  const auto function = *findCanonicalFunction("cosine");
  const CanonicalLine line(function, {});
  for (const double rate : {.85, .95}) {  // the cost has a variance, and a kurtosis for z-tests of its mean
    const double teeth = 8, corrections = 2 * rate / (2 * rate - 1);
    const auto costOf = [&](const auto& estimator, double expected) {
      const auto test = test::runZTest(
          [&](Rng& rng) {
            return static_cast<double>(runEstimator(estimator, line, Channels<1>{1}, rng).tally.lookups);
          },
          expected, kSeed, 30000);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
    };
    costOf(DebiasedRayMarching{.levels = 3, .rate = rate}, teeth * corrections);
    costOf(DebiasedRayMarching{.levels = 3, .rate = rate, .reuse = false}, teeth * (1 + corrections));
    costOf(PrefixDebiasedRayMarching{.levels = 3, .rate = rate}, teeth * corrections);
  }
}

TEST(DebiasedRayMarching, StaysBelowItsLimitAndIsThenAMarchOfTheLastLevel) {
  const auto function = *findCanonicalFunction("gaussian");
  const CanonicalLine line(function, {});
  const AnyLaw law = PinkNoiseLaw{.8};
  const auto check = [&](const auto& estimator, std::uint64_t teeth, double cappedShare) {
    RunningStats values, capped;
    Rng rng(kSeed);
    for (int i = 0; i < 20000; ++i) {
      const auto estimate = runEstimator(estimator, line, Channels<1>{2}, rng);
      ASSERT_LE(estimate.tally.lookups, estimator.maxLookups);
      values.add(estimate.value[0]);
      capped.add(static_cast<double>(estimate.tally.capped));
    }
    const auto test = zTest(values, marchMean(line, teeth, law, 2), kSeed);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
    const auto share = zTest(capped, cappedShare, kSeed);
    EXPECT_LT(std::abs(share.z()), kMaxAbsZ) << share;
    EXPECT_EQ(estimator.traits().bias, EstimatorTraits::Bias::Consistent);
    EXPECT_TRUE(estimator.traits().boundedCost);
  };
  check(DebiasedRayMarching{.law = law, .levels = 1, .maxLookups = 8}, 8, .35 * .35);
  check(DebiasedRayMarching{.law = law, .levels = 1, .reuse = false, .maxLookups = 8}, 4, .35);
  check(DebiasedRayMarching{.law = law, .levels = 4, .maxLookups = 5}, 5, 1);
  check(PrefixDebiasedRayMarching{.law = law, .levels = 1, .maxLookups = 15}, 8, .35 * .35);
  check(PrefixDebiasedRayMarching{.law = law, .levels = 4, .maxLookups = 5}, 5, 1);
}

TEST(DebiasedRayMarching, LooksNowhereInVacuumThatIsProvenAndOnceInOtherVacuum) {
  Rng rng(kSeed);
  const test::ContractLine vacuum(test::ContractLine::Kind::Vacuum);
  const auto proven = runEstimator(DebiasedRayMarching{}, vacuum, Channels<1>{1}, rng);
  EXPECT_EQ(proven.value[0], 1);
  EXPECT_EQ(proven.tally.lookups, 0u);
  const test::FunctionLine unproven{[](double) { return 0.0; }, {{.5, {0, 0}}, {1, {0, 0}}}};
  const auto probed = runEstimator(PrefixDebiasedRayMarching{}, unproven, Channels<1>{1}, rng);
  EXPECT_EQ(probed.value[0], 1);
  EXPECT_EQ(probed.tally.lookups, 2u);
  EXPECT_EQ(probed.tally.violations, 0u);
  const test::FunctionLine wrong{[](double) { return 1.0; }, {{1, {0, 0}}}};
  EXPECT_EQ(runEstimator(DebiasedRayMarching{}, wrong, Channels<1>{1}, rng).tally.violations, 1u);
}

TEST(DebiasedRayMarching, TellsWhenItsVarianceIsFinite) {
  using D = DebiasedRayMarching;
  EXPECT_TRUE(D{}.traits().finiteVariance);
  EXPECT_TRUE((D{.rate = .9}.traits().finiteVariance));
  EXPECT_FALSE((D{.rate = .95}.traits().finiteVariance));
  EXPECT_TRUE((D{.comb = Comb::Independent}.traits().finiteVariance));
  EXPECT_FALSE((D{.rate = .8, .comb = Comb::Independent}.traits().finiteVariance));
  EXPECT_TRUE((D{.law = LinearLaw{}}.traits().finiteVariance));
  EXPECT_FALSE((D{.law = LinearLaw{}, .comb = Comb::Independent}.traits().finiteVariance));
}

TEST(TelescopingLevels, EndWhereACorrectionIsUnaffordable) {
  EXPECT_EQ(TelescopingLevels(4, .65, 0, 0).count(), 28u);
  EXPECT_EQ(TelescopingLevels(1, .65, 0, 0).count(), 30u);
  EXPECT_EQ(TelescopingLevels(4, .65, 7, 0).count(), 0u);
  EXPECT_EQ(TelescopingLevels(4, .65, 8, 0).count(), 1u);
  EXPECT_EQ(TelescopingLevels(4, .65, 8, 4).count(), 0u);
  EXPECT_EQ(TelescopingLevels(4, .65, 3, 4).count(), 0u);
  const TelescopingLevels levels(4, .65, 0, 0);
  EXPECT_EQ(levels.draw(1), 0u);
  EXPECT_EQ(levels.draw(.36), 0u);
  EXPECT_EQ(levels.draw(.34), 1u);
  EXPECT_EQ(levels.draw(.1226), 1u);
  EXPECT_EQ(levels.draw(.1224), 2u);
  EXPECT_LT(TelescopingLevels(1, TelescopingLevels::kLeastRate, 0, 0).draw(0x1p-53), 64u);
}

}  // namespace
}  // namespace pbrtmedia
