// SPDX-License-Identifier: BSD-2-Clause
// The means of the prefix-sum estimators on every canonical function, from thin to thick, under controls from
// too low to loose.
#include <gtest/gtest.h>

#include "transmittance/estimators/bidirectional_mis.h"
#include "transmittance/estimators/p_series_cumulative.h"
#include "transmittance/series_cases.h"
#include "transmittance/series_moments.h"

namespace pbrtmedia {
namespace {

using test::ControlledFunction;
using test::ControlMoments;
using test::expectMeans;

constexpr std::uint64_t kSeed = 20241205;
constexpr double kBudget = 1e5;  ///< look-ups a case
constexpr int kCells = 2000;     ///< of the quadratures: errors far below a standard error

double noClosedForm(const ControlledFunction&) { return 0; }

TEST(NextFlight, HasItsMeanEverywhere) {
  EXPECT_LE(expectMeans(
                NextFlight{}, [](const auto& c) { return test::secondMoment(NextFlight{}, c, kCells); },
                kBudget, kSeed),
            2);
}
TEST(UnidirectionalMis, HasItsMeanEverywhere) {
  EXPECT_LE(
      expectMeans(
          UnidirectionalMis{},
          [](const auto& c) { return test::secondMoment(UnidirectionalMis{}, c, kCells); }, kBudget, kSeed),
      2);
}
TEST(PSeriesNextFlight, HasItsMeanEverywhere) {
  EXPECT_LE(expectMeans(
                PSeriesNextFlight{},
                [](const auto& c) {
                  return test::secondMoment(PSeriesNextFlight{}, ControlMoments(c.line(), c.sigma(), kCells));
                },
                kBudget, kSeed),
            2);
}
TEST(PSeriesCmf, HasItsMeanEverywhere) {
  EXPECT_LE(expectMeans(
                PSeriesCmf{},
                [](const auto& c) {
                  return test::secondMoment(PSeriesCmf{}, ControlMoments(c.line(), c.sigma(), kCells));
                },
                kBudget, kSeed),
            2);
}
TEST(PSeriesCumulative, HasItsMeanEverywhere) {
  EXPECT_EQ(expectMeans(PSeriesCumulative{}, noClosedForm, kBudget, kSeed), 0);
}
TEST(BidirectionalMis, HasItsMeanEverywhere) {
  EXPECT_EQ(expectMeans(BidirectionalMis{}, noClosedForm, kBudget, kSeed), 0);
}

}  // namespace
}  // namespace pbrtmedia
