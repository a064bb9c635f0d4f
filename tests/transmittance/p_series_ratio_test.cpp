// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/p_series_ratio.h"

#include <gtest/gtest.h>

#include "tracking_cases.h"
#include "transmittance/estimators/p_series_residual.h"
#include "transmittance/estimators/ratio_tracking.h"
#include "transmittance/estimators/residual_ratio_tracking.h"

namespace pbrtmedia {
namespace {

using namespace test;

constexpr std::uint64_t kSeed = 20261103;

/// Rounded to float, as equal products in another order differ in their last digits.
template <class Estimator>
std::vector<double> values(const Estimator& estimator, const TrackingCase& c, int n, std::uint64_t seed) {
  std::vector<double> all;
  Rng rng(seed);
  for (int i = 0; i < n; ++i) {
    const double value = runEstimator(estimator, c.line, Channels<1>{c.tau}, rng).value[0];
    all.push_back(double{static_cast<float>(value)});
  }
  return all;
}

TEST(PSeriesRatio, HasTheDistributionOfTheWalk) {
  for (const Shape& s : shapes()) {
    for (const double control : {.8, 1., 2.}) {
      const TrackingCase c = trackingCase(s, 1.5, control, 3);
      const auto test = twoSampleTest(values(PSeriesRatio(), c, 10000, kSeed),
                                      values(RatioTracking(), c, 10000, kSeed + 1));
      EXPECT_GT(test.pValue(), kMinPValue) << c.name << ": " << test;
    }
  }
}

TEST(PSeriesRatio, DiffersInDistributionUnderAnotherBound) {
  // Negative control of the test above: the mean is the same, the distribution is not.
  const TrackingCase tight = trackingCase(shape("rising"), 1.5, 1.0, 3),
                     loose = trackingCase(shape("rising"), 1.5, 1.3, 3);
  const auto test = twoSampleTest(values(PSeriesRatio(), loose, 10000, kSeed),
                                  values(RatioTracking(), tight, 10000, kSeed + 1));
  EXPECT_LT(test.pValue(), kMinPValue) << test;
}

TEST(PSeriesResidual, HasTheDistributionOfTheWalk) {
  for (const Shape& s : shapes()) {
    for (const double control : {.9, 1., 2.}) {
      const TrackingCase c = trackingCase(s, 1.5, control, 5, .8);
      const auto test = twoSampleTest(values(PSeriesResidual(), c, 10000, kSeed),
                                      values(ResidualRatioTracking(), c, 10000, kSeed + 1));
      EXPECT_GT(test.pValue(), kMinPValue) << c.name << ": " << test;
    }
  }
}

TEST(PSeriesResidual, CostsWhatTheWalkCosts) {
  // Look-ups are Poisson distributed where no factor is exactly 0.
  const TrackingCase c = trackingCase(shape("cosine"), 1.5, 1.5, 5, .8);
  const double mean = c.integrate([](double, double upper, double lower) { return upper - lower; });
  Rng rng(kSeed);
  std::vector<double> counted(60, 0), expected(60, 0);
  constexpr int kN = 20000;
  for (int i = 0; i < kN; ++i) {
    ++counted.at(runEstimator(PSeriesResidual(), c.line, Channels<1>{c.tau}, rng).tally.lookups);
  }
  for (std::size_t k = 0; k < counted.size(); ++k) expected[k] = kN * poissonPmf(k, mean);
  EXPECT_GT(chiSquareTest(counted, expected).pValue(), kMinPValue) << chiSquareTest(counted, expected);
}

TEST(PSeriesResidual, IsExactAndFreeWhereBoundsLeaveNothingOpen) {
  const ProvenLine line{{[](double s) { return s < .3   ? 2.0
                                               : s < .6 ? 0.0
                                                        : .5; },
                         {{.3, {2, 2}}, {.6, {0, 0}}, {1, {.5f, .5f}}}}};
  Rng rng(kSeed);
  for (const double sigma : {1e-8, .1, 1., 30., 1e6}) {
    const auto estimate = runEstimator(PSeriesResidual(), line, Channels<1>{sigma}, rng);
    EXPECT_NEAR(estimate.value[0], std::exp(-.8 * sigma), 1e-12 * std::exp(-.8 * sigma)) << sigma;
    EXPECT_EQ(estimate.tally.lookups, 0u);
  }
  FunctionLine wrong = line;
  wrong.function = [](double) { return 3.0; };
  EXPECT_EQ(runEstimator(PSeriesResidual(), wrong, Channels<1>{1}, rng).tally.violations, 3u);
}

TEST(PSeriesRatio, ServesEachChannel) {
  const Channels<3> sigma{2, 0, .3};
  for (const Shape& s : shapes()) {
    const TrackingCase c = trackingCase(s, 1, 1.5, 4, .7);
    Rng rng(kSeed);
    RunningStats ratio[3], residual[3];
    for (int i = 0; i < 10000; ++i) {
      const auto a = runEstimator(PSeriesRatio(), c.line, sigma, rng);
      const auto b = runEstimator(PSeriesResidual(), c.line, sigma, rng);
      for (std::size_t k = 0; k < 3; ++k) {
        ratio[k].add(a.value[k]);
        residual[k].add(b.value[k]);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      expectMean(ratio[k], std::exp(-sigma[k]), kSeed, c.name);
      expectMean(residual[k], std::exp(-sigma[k]), kSeed, c.name + ", residual");
    }
  }
}

TEST(PSeriesRatio, GainsFromAPatternWhereItsWalkGainsLess) {
  // The number of collisions and each point are dimensions of their own, so a Latin hypercube stratifies
  // them.
  const TrackingCase c = trackingCase(shape("rising"), 1, 1.0);
  constexpr std::uint32_t kCount = 64;
  const auto varianceOfMeans = [&](const auto& estimator, PatternKind kind) {
    RunningStats means;
    for (std::uint64_t pixel = 0; pixel < 600; ++pixel) {
      const SamplingPattern pattern(kind, kCount, kSeed + pixel);
      Rng rng(kSeed + pixel);
      double sum = 0;
      for (std::uint32_t i = 0; i < kCount; ++i) {
        SampleStream stream(rng, pattern, i);
        sum += estimator(c.line, Channels<1>{c.tau}, stream).value[0];
      }
      means.add(sum / kCount);
    }
    expectMean(means, std::exp(-c.tau), kSeed, "mean under a pattern");
    return means.variance();
  };
  const double independent = varianceOfMeans(PSeriesRatio(), PatternKind::Independent),
               series = varianceOfMeans(PSeriesRatio(), PatternKind::LatinHypercube),
               walk = varianceOfMeans(RatioTracking(), PatternKind::LatinHypercube);
  EXPECT_LT(series, .5 * independent);
  EXPECT_LT(series, walk);
}

TEST(PSeriesRatio, EndsAtItsLimitAndSaysSo) {
  const TrackingCase c = trackingCase(shape("constant"), 1, 1000, 1, .1);
  Rng rng(kSeed);
  const auto a = runEstimator(PSeriesRatio{.maxLookups = 7}, c.line, Channels<1>{1}, rng);
  EXPECT_EQ(a.tally.lookups, 7u);
  EXPECT_EQ(a.tally.capped, 1u);
  EXPECT_NEAR(a.value[0], std::pow(.999, 7), 1e-9);
  const auto b = runEstimator(PSeriesResidual{.maxLookups = 7}, c.line, Channels<1>{1e12}, rng);
  EXPECT_EQ(b.tally.lookups, 7u);
  EXPECT_EQ(b.tally.capped, 1u);
}

}  // namespace
}  // namespace pbrtmedia
