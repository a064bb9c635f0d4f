// SPDX-License-Identifier: BSD-2-Clause
// The estimators that sum the power series: p-series next-flight, cumulative and CMF.
#include <gtest/gtest.h>

#include <cmath>
#include <memory_resource>
#include <vector>

#include "support/control_moments.h"
#include "transmittance/estimators/p_series_cmf.h"
#include "transmittance/estimators/p_series_cumulative.h"
#include "transmittance/estimators/p_series_next_flight.h"
#include "transmittance/series_cases.h"
#include "transmittance/series_moments.h"

namespace pbrtmedia {
namespace {

using test::ControlledFunction;
using test::ControlMoments;
using test::kMaxAbsZ;
using test::runEstimator;
using test::secondMoment;

constexpr std::uint64_t kSeed = 20241204;

TEST(PSeriesCmf, EvaluatesTheCertainLevelsOfThePaperAndOfItsPublishedImages) {
  const struct {
    double depth;
    std::uint64_t printed;
    double printedCost;
    std::uint64_t code;
    double codeCost;
  } rows[] = {{.1, 1, 1.052, 2, 2.034},         {.5, 3, 3.139, 4, 4.109},       {1, 4, 4.239, 5, 5.194},
              {2, 6, 6.377, 7, 7.319},          {2.302585, 6, 6.455, 7, 7.383}, {5, 11, 11.662, 12, 12.588},
              {10, 18, 19.013, 19, 19.926},     {20, 31, 32.503, 32, 33.405},   {50, 67, 69.478, 68, 70.370},
              {100, 124, 127.552, 125, 128.440}};
  for (const auto& row : rows) {
    EXPECT_EQ(PSeriesCmf{.levelCount = LevelCount::Printed}.certainLevels(row.depth), row.printed);
    EXPECT_EQ(PSeriesCmf{}.certainLevels(row.depth), row.code);
    EXPECT_NEAR(test::expectedLookups(row.depth, row.printed), row.printedCost, 5.1e-4) << row.depth;
    EXPECT_NEAR(test::expectedLookups(row.depth, row.code), row.codeCost, 5.1e-4) << row.depth;
    for (const auto kind : {LevelCount::Printed, LevelCount::Code}) {
      const PSeriesCmf estimator{.levelCount = kind};
      const ControlledFunction c("hole", row.depth, 1.25);  // above the plateau: no exact zeros
      const double scale = row.depth / c.depth();           // the control's depth is that of the row
      const auto run = test::runMany(estimator, c.line(), row.depth * scale, 0, 4000, kSeed);
      const auto cost = test::zTest(
          run.lookups, test::expectedLookups(row.depth, estimator.certainLevels(row.depth)), kSeed);
      EXPECT_LT(std::abs(cost.z()), kMaxAbsZ) << row.depth << ": " << cost;
    }
  }
}

TEST(PSeriesCmf, StillLooksOnceInTheThinnestMediumUnlessPrinted) {
  EXPECT_EQ(PSeriesCmf{}.certainLevels(1e-300), 1u);
  EXPECT_EQ(PSeriesCmf{.levelCount = LevelCount::Printed}.certainLevels(1e-300), 0u);
}

TEST(PSeriesCmf, KeepsTheDigitsOfWhatAThinMediumTakes) {
  for (const double tau : {1e-4, 1e-8, 1e-12}) {
    const ControlledFunction c("constant", tau, 2);
    Rng rng(kSeed);
    const double value = runEstimator(PSeriesCmf{}, c.line(), Channels<1>{tau}, rng).value[0];
    EXPECT_NEAR(1 - value, -std::expm1(-tau), 3 * tau * tau + 1e-15);
  }
}

template <class Estimator>
void expectTheory(const Estimator& estimator, const ControlledFunction& c) {
  const double truth = std::exp(-c.tau());
  const double variance = secondMoment(estimator, ControlMoments(c.line(), c.sigma())) - truth * truth;
  const auto run = test::runMany(estimator, c.line(), c.sigma(), truth, 60000, kSeed);
  EXPECT_LT(std::abs(test::zOfMean(run.value, truth, variance, c.tau())), kMaxAbsZ)
      << c.what() << ": " << test::zTest(run.value, truth);
  const auto spread = test::zTest(run.squares, variance, kSeed);
  EXPECT_LT(std::abs(spread.z()), kMaxAbsZ) << c.what() << ", variance: " << spread;
}

TEST(PSeries, HasTheMeanAndTheVarianceOfTheory) {
  for (const auto& c : {ControlledFunction("cosine", 1, 1), ControlledFunction("linear-up", 2.3, 1.5),
                        ControlledFunction("gaussian", .5, 1), ControlledFunction("step", 1, .8),
                        ControlledFunction("hole", .1, .1), ControlledFunction("linear-down", 2, 1, 7)}) {
    expectTheory(PSeriesNextFlight{}, c);
    expectTheory(PSeriesCmf{}, c);
    expectTheory(PSeriesCmf{.levelCount = LevelCount::Printed}, c);
  }
}

TEST(PSeries, TellsTheTwoLevelCountsApartByVariance) {
  // Negative control of the above.
  const ControlledFunction c("constant", .5, 2);
  const double truth = std::exp(-c.tau());
  const double printed =
      secondMoment(PSeriesCmf{.levelCount = LevelCount::Printed}, ControlMoments(c.line(), c.sigma())) -
      truth * truth;
  const auto run = test::runMany(PSeriesCmf{}, c.line(), c.sigma(), truth, 60000, kSeed);
  EXPECT_GT(std::abs(test::zTest(run.squares, printed, kSeed).z()), kMaxAbsZ);
}

TEST(PSeriesNextFlight, SpendsTheOpticalDepthOfItsBound) {
  const ControlledFunction c("cosine", 1, 1.7, 3);
  const auto run = test::runMany(PSeriesNextFlight{}, c.line(), 1, 0, 40000, kSeed);
  const auto cost = test::zTest(run.lookups, c.depth(), kSeed);
  EXPECT_LT(std::abs(cost.z()), kMaxAbsZ) << cost;
}

TEST(PSeriesNextFlight, ForgetsTheDirectionThatTheWalkFeels) {
  // Its points have no order: mirrored media have one variance, between those of the walk from either end.
  const ControlledFunction up("linear-up", 1, 1.05), down("linear-down", 1, 1.05);
  const double upwards = secondMoment(PSeriesNextFlight{}, ControlMoments(up.line(), 1));
  const double downwards = secondMoment(PSeriesNextFlight{}, ControlMoments(down.line(), 1));
  EXPECT_NEAR(upwards, downwards, 1e-8);
  EXPECT_LT(secondMoment(NextFlight{}, up), .9 * upwards);
  EXPECT_GT(secondMoment(NextFlight{}, down), 1.1 * upwards);
}

TEST(PSeriesNextFlight, HasHazardsThatAgreeWithPoissonTails) {
  for (const double mean : {1e-9, .1, 1., 30., 800., 1e5}) {
    const double spread = 1 + std::sqrt(mean);
    const auto last = static_cast<std::uint64_t>(mean + 8 * spread);
    const std::uint64_t first = PSeriesNextFlight::firstOrderThatCounts(mean);
    const auto hazards = PSeriesNextFlight::hazardsDown(last, first, mean, std::pmr::get_default_resource());
    ASSERT_EQ(hazards.size(), last - first + 1);
    for (std::uint64_t j = first; j <= last; j += 1 + last / 500) {
      const double truth = poissonPmf(j, mean) / poissonTail(j, mean);
      if (poissonPmf(j, mean) < 1e-280) continue;  // no digits are promised there
      ASSERT_NEAR(hazards[last - j], truth, 1e-9 * truth) << "mean " << mean << ", order " << j;
    }
    if (first > 0) {
      EXPECT_EQ(poissonPmf(first - 1, mean), 0) << mean;
    }
  }
}

TEST(PSeriesNextFlight, IsExactUnderTheTightestBoundOfAConstant) {
  for (const double tau : {1e-8, .1, 3., 700.}) {
    const ControlledFunction c("constant", tau, 1);
    Rng rng(kSeed);
    for (int i = 0; i < 50; ++i) {
      const auto estimate = runEstimator(PSeriesNextFlight{}, c.line(), Channels<1>{tau}, rng);
      ASSERT_NEAR(estimate.value[0], std::exp(-tau), 1e-11 * std::exp(-tau));
    }
  }
}

TEST(PSeriesCumulative, HasTheLawOfItsDefinitionInAConstantMedium) {
  // There only the roulette is random: the chance of every end, with the sum held then, by enumeration.
  for (const double tau : {.1, .7, 2., 5.}) {
    for (const double control : {.1, .6, 1.2, 2., 10.}) {
      const ControlledFunction c("constant", tau, control);
      const test::CumulativeInConstant theory(c.depth(), 1 - tau / c.depth());
      const double truth = std::exp(-tau);
      EXPECT_NEAR(theory.mean, truth, 1e-9 * std::max(truth, theory.largest)) << c.what();
      const auto run = test::runMany(PSeriesCumulative{}, c.line(), tau, truth, 40000, kSeed);
      EXPECT_LT(std::abs(test::zOfMean(run.value, truth, theory.variance, tau)), kMaxAbsZ) << c.what();
      EXPECT_LT(std::abs(run.squares.mean() - theory.variance),
                kMaxAbsZ * run.squares.standardError() + 1e-6 * (theory.variance + truth * truth))
          << c.what() << ": " << run.squares.mean() << " for " << theory.variance;
      const auto cost = test::zTest(run.lookups, theory.lookups, kSeed);
      EXPECT_LT(std::abs(cost.z()), kMaxAbsZ) << c.what() << ", look-ups: " << cost;
    }
  }
}

TEST(PSeriesCumulative, IsExactWhereItsTermsRiseBeyondDouble) {
  // e^{-tau_bar} times a sum up to e^{tau_bar - 1}, whose last terms no longer count.
  for (const double control : {1e3, 1e5}) {
    const ControlledFunction c("constant", 1, control);
    Rng rng(kSeed);
    const auto estimate = runEstimator(PSeriesCumulative{}, c.line(), Channels<1>{1}, rng);
    EXPECT_NEAR(estimate.value[0], std::exp(-1), 1e-7);
    EXPECT_GT(static_cast<double>(estimate.tally.lookups), 2.7 * control);
    EXPECT_LT(static_cast<double>(estimate.tally.lookups), 2.8 * control);
  }
}

TEST(PSeries, LosesNoDigitsUnderAControlOfHundredThousand) {
  for (const double control : {1e3, 1e5}) {
    const ControlledFunction c("constant", 1, control);
    const double truth = std::exp(-1), depth = c.depth();
    const double second = secondMoment(PSeriesCmf{}, ControlMoments(c.line(), 1, 1));
    const double spread = std::sqrt(second - truth * truth);  // of the terms beyond 99 % of the mass
    EXPECT_LT(spread, .03 * truth);
    Rng rng(kSeed);
    for (int i = 0; i < 4; ++i) {
      const auto cmf = runEstimator(PSeriesCmf{}, c.line(), Channels<1>{1}, rng);
      EXPECT_NEAR(cmf.value[0], truth, kMaxAbsZ * spread);
      EXPECT_NEAR(static_cast<double>(cmf.tally.lookups), depth, 40 * std::sqrt(depth));
      const auto walk = runEstimator(PSeriesNextFlight{}, c.line(), Channels<1>{1}, rng);
      EXPECT_GE(walk.value[0], 0);
      EXPECT_LT(walk.value[0], 20);
      EXPECT_NEAR(static_cast<double>(walk.tally.lookups), depth, 6 * std::sqrt(depth));
    }
  }
}

TEST(PSeries, SharesOneUniformPerDecisionInAnOrderThatAPatternCanRelyOn) {
  // The point of order i is dimension i of p-series next-flight, whatever its number of points; of
  // p-series CMF i - 1; of p-series cumulative 2 (i - 1).
  const ControlledFunction c("cosine", 1, 1);
  const SamplingPattern pattern(PatternKind::Hammersley, 8, 3);
  const auto pointsOf = [&](const auto& estimator, std::uint32_t index) {
    std::vector<double> points;
    CanonicalLine line = c.line();
    line.record(&points);
    Rng rng(1);
    SampleStream stream(rng, pattern, index);
    estimator(line, Channels<1>{1}, stream);
    return points;
  };
  std::size_t seen = 0;
  for (std::uint32_t index = 0; index < 8; ++index) {
    const auto next = pointsOf(PSeriesNextFlight{}, index), cumulative = pointsOf(PSeriesCumulative{}, index),
               cmf = pointsOf(PSeriesCmf{}, index);
    for (std::uint32_t i = 0; i < next.size(); ++i, ++seen) {
      EXPECT_NEAR(next[i], pattern.value(index, 1 + i), 1e-12);
    }
    for (std::uint32_t i = 0; i < cumulative.size(); ++i, ++seen) {
      EXPECT_NEAR(cumulative[i], pattern.value(index, 2 * i), 1e-12);
    }
    for (std::uint32_t i = 0; i < PSeriesCmf{}.certainLevels(c.depth()); ++i, ++seen) {
      EXPECT_NEAR(cmf[i], pattern.value(index, i), 1e-12);
    }
  }
  EXPECT_GT(seen, 50u);
}

}  // namespace
}  // namespace pbrtmedia
