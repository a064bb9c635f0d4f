// SPDX-License-Identifier: BSD-2-Clause
// Variances and costs on the canonical functions of Georgiev et al. 2019, figure 7: independent reference
// values, some exact, some from two million runs, rounded to the digits shown.
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "transmittance/estimators/p_series_cumulative.h"
#include "transmittance/series_cases.h"
#include "transmittance/series_moments.h"

namespace pbrtmedia {
namespace {

using test::ControlledFunction;
using test::ControlMoments;
using test::kMaxAbsZ;

constexpr std::uint64_t kSeed = 20241206;

/// A value and the unit of its last digit.
struct Printed {
  double value, unit;
};
struct Row {
  std::string_view function;
  double transmittance, ratio;  ///< of the requested depth tau; tau / control depth
  Printed cmf, cmfCost, next, nextCost, cumulative, cumulativeCost;
};
constexpr Row kRows[] = {
    {"constant",
     .9,
     .95,
     {2e-14, 1e-14},
     {2.04, .01},
     {2.1e-4, 1e-5},
     {.111, .001},
     {4.5e-3, 1e-4},
     {1.01, .01}},
    {"constant", .5, .95, {0, 1e-14}, {4.17, .01}, {3.2e-4, 1e-5}, {.730, .001}, {8.6e-3, 1e-4}, {1.04, .01}},
    {"constant",
     .5,
     .475,
     {2.5e-10, 1e-11},
     {6.25, .01},
     {3.48e-2, 1e-4},
     {1.46, .01},
     {4.43e-2, 1e-4},
     {2.15, .01}},
    {"constant",
     .1,
     .475,
     {2e-13, 1e-13},
     {12.56, .01},
     {6.4e-3, 1e-4},
     {4.85, .01},
     {6.3e-5, 1e-6},
     {6.46, .01}},
    {"cosine",
     .9,
     .45,
     {3.81e-3, 1e-5},
     {3.06, .01},
     {6.49e-2, 1e-4},
     {.234, .001},
     {8.50e-2, 1e-4},
     {1.14, .01}},
    {"cosine",
     .5,
     .45,
     {3.087e-2, 1e-5},
     {6.271, .001},
     {7.99e-2, 1e-4},
     {1.54, .01},
     {5.89e-2, 1e-4},
     {2.17, .01}},
    {"cosine",
     .5,
     .225,
     {1.576e-2, 1e-5},
     {9.423, .001},
     {9.06e-2, 1e-4},
     {3.08, .01},
     {1.80e-2, 1e-4},
     {5.91, .01}},
    {"cosine",
     .1,
     .45,
     {7.645e-3, 1e-6},
     {12.61, .01},
     {1.49e-2, 1e-4},
     {5.12, .01},
     {7.73e-3, 1e-5},
     {5.50, .01}},
    {"gaussian",
     .9,
     .12,
     {2.29e-2, 1e-4},
     {5.17, .01},
     {3.25e-1, 1e-3},
     {.878, .001},
     {1.42e-1, 1e-3},
     {2.17, .01}},
    {"gaussian",
     .5,
     .12,
     {9.663e-2, 1e-5},
     {13.66, .01},
     {3.38e-1, 1e-3},
     {5.78, .01},
     {9.69e-2, 1e-4},
     {11.35, .01}},
    {"gaussian",
     .1,
     .12,
     {2.465e-2, 1e-5},
     {32.37, .01},
     {6.18e-2, 1e-4},
     {19.19, .01},
     {2.46e-2, 1e-4},
     {39.5, .1}},
    {"hole",
     .5,
     .85,
     {1.029e-2, 1e-5},
     {4.19, .01},
     {1.90e-2, 1e-4},
     {.815, .001},
     {2.54e-2, 1e-4},
     {1.13, .01}},
    {"hole",
     .1,
     .85,
     {3.946e-3, 1e-6},
     {8.41, .01},
     {3.28e-3, 1e-5},
     {2.71, .01},
     {4.65e-3, 1e-5},
     {1.33, .01}},
    {"linear-up",
     .5,
     .45,
     {2.143e-2, 1e-5},
     {6.27, .01},
     {4.14e-2, 1e-4},
     {1.54, .01},
     {5.30e-2, 1e-4},
     {2.23, .01}},
    {"linear-up",
     .1,
     .45,
     {5.095e-3, 1e-6},
     {12.61, .01},
     {4.87e-4, 1e-6},
     {5.12, .01},
     {5.15e-3, 1e-5},
     {6.09, .01}}};

ControlledFunction controlled(const Row& row) {
  const double tau = -std::log(row.transmittance);
  const double maximum = ControlledFunction(row.function, 1, 1).maximum();
  return {row.function, tau, 1 / (row.ratio * maximum)};
}

/// Sampled value within kMaxAbsZ standard errors and one unit of the last printed digit.
void expectPrinted(const test::RunningStats& values, const Printed& printed, const std::string& what) {
  EXPECT_LE(std::abs(values.mean() - printed.value), kMaxAbsZ * values.standardError() + printed.unit)
      << what << ": " << test::zTest(values, printed.value, kSeed);
}

constexpr int kRuns = 60000;
/// Of the printed values that are not exact.
constexpr double kPrintedRuns = 2e6;

/// Answers the standard error of the variance.
template <class Estimator>
double expectRuns(const Estimator& estimator, const Row& row, const Printed& variance, const Printed& cost) {
  const ControlledFunction c = controlled(row);
  const auto run = test::runMany(estimator, c.line(), c.sigma(), std::exp(-c.tau()), kRuns, kSeed);
  expectPrinted(run.squares, variance, std::string(Estimator::kName) + ", variance, " + c.what());
  expectPrinted(run.lookups, cost, std::string(Estimator::kName) + ", look-ups, " + c.what());
  return run.squares.standardError();
}

TEST(CanonicalMaps, NextFlightHasThePrintedVarianceAndCost) {
  for (const Row& row : kRows) {
    const ControlledFunction c = controlled(row);
    const double truth = std::exp(-c.tau());
    const double variance = test::secondMoment(NextFlight{}, c) - truth * truth;
    const double error =
        expectRuns(NextFlight{}, row, row.next, row.nextCost) * std::sqrt(kRuns / kPrintedRuns);
    EXPECT_NEAR(variance, row.next.value, kMaxAbsZ * error + row.next.unit) << c.what();
    EXPECT_NEAR(c.depth(), row.nextCost.value, .51 * row.nextCost.unit) << c.what();
  }
}

TEST(CanonicalMaps, PSeriesCmfHasThePrintedVarianceAndCost) {
  for (const Row& row : kRows) {
    const ControlledFunction c = controlled(row);
    const double truth = std::exp(-c.tau());
    const int cells = row.function == "constant" ? 1 : 20000;  // one is exact, without the rounding of a sum
    const double variance =
        test::secondMoment(PSeriesCmf{}, ControlMoments(c.line(), c.sigma(), cells)) - truth * truth;
    EXPECT_NEAR(variance, row.cmf.value, .51 * row.cmf.unit + 1e-5 * row.cmf.value) << c.what();
    EXPECT_NEAR(test::expectedLookups(c.depth(), PSeriesCmf{}.certainLevels(c.depth())), row.cmfCost.value,
                .51 * row.cmfCost.unit)
        << c.what();
    expectRuns(PSeriesCmf{}, row, row.cmf, row.cmfCost);
  }
}

TEST(CanonicalMaps, PSeriesCumulativeHasThePrintedVarianceAndCost) {
  for (const Row& row : kRows) expectRuns(PSeriesCumulative{}, row, row.cumulative, row.cumulativeCost);
}

TEST(CanonicalMaps, AnotherRowIsRejected) {
  // Negative control: the numbers of one estimator do not pass for another's.
  const Row& row = kRows[5];
  const ControlledFunction c = controlled(row);
  const auto run = test::runMany(NextFlight{}, c.line(), c.sigma(), std::exp(-c.tau()), kRuns, kSeed);
  EXPECT_GT(std::abs(run.squares.mean() - row.cumulative.value),
            kMaxAbsZ * run.squares.standardError() + row.cumulative.unit);
}

}  // namespace
}  // namespace pbrtmedia
