// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/interval_product.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "support/contract_line.h"
#include "transmittance/estimator_list.h"
#include "transmittance/series_cases.h"
#include "transmittance/series_moments.h"

namespace pbrtmedia {
namespace {

using test::ContractLine;
using test::ControlledFunction;
using test::ControlMoments;
using test::kMaxAbsZ;
using test::runEstimator;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20261130;

/// The product over the intervals of what `ofPart` says of each as a line of its own.
double productOverIntervals(const CanonicalLine& line,
                            const std::function<double(const CanonicalLine&)>& ofPart) {
  double product = 1;
  line.walk([&](double sEnter, double sExit, const auto&) {
    product *= ofPart(line.stretch(sEnter, sExit));
    return true;
  });
  return product;
}

struct Found {
  RunningStats value, square, lookups;
};
Found trials(const IntervalProduct& estimator, const ControlledFunction& c, int n) {
  Found found;
  const CanonicalLine line = c.line();
  Rng rng(kSeed);
  for (int i = 0; i < n; ++i) {
    const auto estimate = runEstimator(estimator, line, Channels<1>{c.sigma()}, rng);
    found.value.add(estimate.value[0]);
    found.square.add(estimate.value[0] * estimate.value[0]);
    found.lookups.add(static_cast<double>(estimate.tally.lookups));
  }
  return found;
}

TEST(IntervalProduct, OfExactEstimatesIsExact) {
  const IntervalProduct exact{.base = RegularTracking{}};
  Rng rng(kSeed);
  for (const unsigned superVoxels : {1u, 2u, 7u, 64u}) {
    for (const std::string_view name : {"linear-up", "step", "piecewise-random"}) {
      const ControlledFunction c(name, 3, 1.5, superVoxels);
      const double found = runEstimator(exact, c.line(), Channels<1>{c.sigma()}, rng).value[0];
      EXPECT_NEAR(found / std::exp(-c.tau()), 1, 1e-12) << c.what();
    }
  }
  const auto channels = runEstimator(exact, ContractLine(), Channels<3>{0, 1, 3}, rng);
  EXPECT_EQ(channels.value[0], 1);
  EXPECT_NEAR(channels.value[1], std::exp(-ContractLine::integral()), 1e-6);
  EXPECT_NEAR(channels.value[2], std::exp(-3 * ContractLine::integral()), 1e-6);
}

/// Piecewise constant, so that all of it is a closed form: E[T^2] = prod_i E[T_i^2].
TEST(IntervalProduct, MultipliesSecondMomentsOfSeries) {
  const IntervalProduct product{.base = PSeriesCmf{}};
  for (const unsigned superVoxels : {4u, 8u}) {
    const ControlledFunction c("step", 2, 1.5, superVoxels);
    const double second = productOverIntervals(c.line(), [&](const CanonicalLine& part) {
      return secondMoment(PSeriesCmf{}, ControlMoments(part, c.sigma()));
    });
    const Found found = trials(product, c, 100000);
    const auto mean = zTest(found.value, std::exp(-c.tau()), kSeed);
    const auto square = zTest(found.square, second, kSeed);
    EXPECT_LT(std::abs(mean.z()), kMaxAbsZ) << c.what() << ": " << mean;
    EXPECT_LT(std::abs(square.z()), kMaxAbsZ) << c.what() << ": " << square;
    // Negative control: the second moment of the whole line is another one, and would be seen.
    const double whole = secondMoment(PSeriesCmf{}, ControlMoments(c.line(), c.sigma()));
    EXPECT_GT(std::abs(zTest(found.square, whole, kSeed).z()), 2 * kMaxAbsZ) << c.what();
  }
}

TEST(IntervalProduct, CostsWhatItsBaseCostsOnEachInterval) {
  const IntervalProduct product{.base = PSeriesCmf{}};
  const ControlledFunction c("cosine", 2, 1.2, 8);
  double expected = 0, certain = 0;
  c.line().walk([&](double sEnter, double sExit, const auto& bound) {
    const double depth = c.sigma() * (sExit - sEnter) * bound.upper;
    const std::uint64_t levels = PSeriesCmf{}.certainLevels(depth);
    expected += test::expectedLookups(depth, levels);
    certain += static_cast<double>(levels);
    return true;
  });
  const Found found = trials(product, c, 20000);
  const auto cost = zTest(found.lookups, expected, kSeed);
  EXPECT_LT(std::abs(cost.z()), kMaxAbsZ) << cost;
  EXPECT_GE(certain, 8) << "at least one look-up for each interval";
  const double whole = test::expectedLookups(c.depth(), PSeriesCmf{}.certainLevels(c.depth()));
  EXPECT_GT(expected, 2 * whole) << "on the whole line series cost less";
}

/// Free paths forget where they began, so walks in pieces are walks: E[T^2] = exp(-2 tau + integral of mu^2 /
/// control).
TEST(IntervalProduct, LeavesRatioTrackingAsItIs) {
  for (const double control : {.8, 1.5}) {
    const ControlledFunction c("linear-up", 1.5, control, 8);
    double chi = 0;
    test::walkControl(c.line(), c.sigma(), [&](const test::ControlPoint& p) { chi = p.chi; });
    const Found found = trials({}, c, 100000);
    const auto mean = zTest(found.value, std::exp(-c.tau()), kSeed);
    const auto square = zTest(found.square, std::exp(chi - 2 * c.tau()), kSeed);
    const auto cost = zTest(found.lookups, c.depth(), kSeed);
    EXPECT_LT(std::abs(mean.z()), kMaxAbsZ) << c.what() << ": " << mean;
    EXPECT_LT(std::abs(square.z()), kMaxAbsZ) << c.what() << ": " << square;
    EXPECT_LT(std::abs(cost.z()), kMaxAbsZ) << c.what() << ": " << cost;
  }
}

TEST(IntervalProduct, PaysNothingForVacuumUnderProvenBounds) {
  // The first interval of this line is empty, the third constant under its own bound.
  const ContractLine line;
  Rng rng(kSeed);
  const IntervalProduct product{.base = PSeriesCmf{}};
  const std::uint64_t least = PSeriesCmf{}.certainLevels(1e-9);
  const auto estimate = runEstimator(product, line, Channels<1>{1e-9}, rng);
  EXPECT_GE(estimate.tally.lookups, 3 * least);
  EXPECT_LE(estimate.tally.lookups, 3 * least + 3);
}

TEST(IntervalProduct, TellsWhereOnTheWholeLineABoundFails) {
  const auto step = *findCanonicalFunction("step");
  const CanonicalLine line(step, {.control = .5, .superVoxels = 4});
  Rng rng(kSeed);
  std::uint64_t violations = 0;
  for (int i = 0; i < 200; ++i) {
    const auto tally = runEstimator(IntervalProduct{}, line, Channels<1>{20}, rng).tally;
    violations += tally.violations;
    if (tally.violations == 0) continue;
    const double bound = line.intervals()[line.intervalAt(tally.worstS)].bound.upper;
    EXPECT_DOUBLE_EQ(tally.worstBound, bound);
    EXPECT_DOUBLE_EQ(tally.worstDensity, line.density(tally.worstS));
    EXPECT_DOUBLE_EQ(tally.worstRatio, tally.worstDensity / tally.worstBound);
  }
  EXPECT_GT(violations, 200u);
}

TEST(IntervalProduct, ALimitCutsOneEstimateHoweverManyIntervals) {
  const ControlledFunction c("constant", 50, 1.5, 8);
  RatioTracking limited;
  limited.maxLookups = 1;
  Rng rng(kSeed);
  const auto tally =
      runEstimator(IntervalProduct{.base = limited}, c.line(), Channels<1>{c.sigma()}, rng).tally;
  EXPECT_EQ(tally.capped, 1u);
}

TEST(IntervalProduct, TakesEveryExponentialEstimatorAndPromisesWhatThatDoes) {
  AnyEstimator estimator = IntervalProduct{};
  for (const std::string_view name : alternativeNames<AnyExponentialEstimator>()) {
    const AssignResult set = setParameter(estimator, "base", std::string(name));
    ASSERT_TRUE(set.known && !set.error) << name;
    const EstimatorTraits alone = traitsOf(*findEstimator(name)), traits = traitsOf(estimator);
    EXPECT_EQ(traits.bias, alone.bias) << name;
    EXPECT_EQ(traits.control, alone.control) << name;
    EXPECT_EQ(traits.needsPieces, alone.needsPieces) << name;
    EXPECT_FALSE(traits.tellsSpread) << name;
    EXPECT_EQ(traits.laws, LawSet::exponential()) << name;
    if (alone.bias != EstimatorTraits::Bias::Unbiased) continue;
    RunningStats values;
    Rng rng(kSeed);
    for (int i = 0; i < 3000; ++i) {
      values.add(visitEstimator(
          [&](const auto& held) {
            return runEstimator(held, ContractLine(1.3), Channels<1>{1}, rng).value[0];
          },
          estimator));
    }
    const double truth = std::exp(-ContractLine::integral());
    EXPECT_LE(std::abs(values.mean() - truth), kMaxAbsZ * values.standardError() + 1e-6)
        << name << ": " << zTest(values, truth, kSeed);
  }
  EXPECT_FALSE(setLaw(estimator, PinkNoiseLaw{.8}));
  const AssignResult wrong = setParameter(estimator, "base", std::string("interval-product"));
  ASSERT_TRUE(wrong.known && wrong.error);
  EXPECT_NE(wrong.error->find("expected one of ratio"), std::string::npos) << *wrong.error;
}

}  // namespace
}  // namespace pbrtmedia
