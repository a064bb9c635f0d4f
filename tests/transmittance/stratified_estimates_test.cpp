// SPDX-License-Identifier: BSD-2-Clause
// Estimates that share a sampling pattern: still unbiased, and of the variance that was measured elsewhere
// for Georgiev et al. 2019, figure 12.
#include <gtest/gtest.h>

#include <cmath>

#include "transmittance/estimators/bidirectional_mis.h"
#include "transmittance/estimators/next_flight.h"
#include "transmittance/estimators/p_series_cmf.h"
#include "transmittance/estimators/p_series_cumulative.h"
#include "transmittance/estimators/p_series_next_flight.h"
#include "transmittance/estimators/p_series_ratio.h"
#include "transmittance/estimators/ratio_tracking.h"
#include "transmittance/estimators/unidirectional_mis.h"
#include "transmittance/series_cases.h"

namespace pbrtmedia {
namespace {

using test::ControlledFunction;
using test::kMaxAbsZ;
using test::RunningStats;

constexpr std::uint64_t kSeed = 20241207;

/// Means of `count` estimates that share one pattern, one for each of `repetitions` keys: the values, and
/// their squared distances from the truth.
struct SharedRun {
  RunningStats means, squares;
};
template <class Estimator>
SharedRun runShared(const Estimator& estimator, const ControlledFunction& c, PatternKind kind,
                    std::uint32_t count, int repetitions) {
  const CanonicalLine line = c.line();
  const double truth = std::exp(-c.tau());
  SharedRun run;
  Rng rng(kSeed);
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const SamplingPattern pattern(kind, count, rng.next());
    double sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      SampleStream stream(rng, pattern, i);
      sum += estimator(line, Channels<1>{c.sigma()}, stream).value[0];
    }
    const double mean = sum / count;
    run.means.add(mean);
    run.squares.add((mean - truth) * (mean - truth));
  }
  return run;
}

template <class Estimator>
class SharedPattern : public testing::Test {};
using Estimators = testing::Types<RatioTracking, PSeriesRatio, NextFlight, UnidirectionalMis,
                                  BidirectionalMis, PSeriesNextFlight, PSeriesCumulative, PSeriesCmf>;
TYPED_TEST_SUITE(SharedPattern, Estimators);

TYPED_TEST(SharedPattern, KeepsTheMeanAndLowersTheVariance) {
  const ControlledFunction c("cosine", 1, 1.5);
  const double truth = std::exp(-c.tau());
  const double independent = runShared(TypeParam{}, c, PatternKind::Independent, 16, 2000).squares.mean();
  for (const auto kind : {PatternKind::LatinHypercube, PatternKind::Hammersley, PatternKind::Halton,
                          PatternKind::ScrambledHalton}) {
    const SharedRun run = runShared(TypeParam{}, c, kind, 16, 2000);
    const auto mean = test::zTest(run.means, truth, kSeed);
    EXPECT_LT(std::abs(mean.z()), kMaxAbsZ) << kPatternNames[static_cast<std::size_t>(kind)] << ": " << mean;
    EXPECT_LT(run.squares.mean(), independent) << kPatternNames[static_cast<std::size_t>(kind)];
  }
}

struct Printed {
  double value, unit;
};
struct Row {
  double tau, depth;
  std::uint32_t count;
  Printed ratio[3], series[3];  ///< independent, Latin hypercube, Hammersley
};

TEST(StratifiedEstimates, HaveTheVarianceOfTheMeanThatWasMeasuredElsewhere) {
  const Row rows[] = {
      {1, 2.2222, 1, {{.128, .001}, {.128, .001}, {.128, .001}}, {{.128, .001}, {.128, .001}, {.128, .001}}},
      {1,
       2.2222,
       16,
       {{8.0e-3, 1e-4}, {3.0e-3, 1e-4}, {2.4e-3, 1e-4}},
       {{8.1e-3, 1e-4}, {2.0e-3, 1e-4}, {1.6e-3, 1e-4}}},
      {1,
       2.2222,
       256,
       {{4.9e-4, 1e-5}, {1.3e-4, 1e-5}, {4.2e-5, 1e-6}},
       {{5.0e-4, 1e-5}, {9.5e-5, 1e-6}, {1.7e-5, 1e-6}}},
      {1,
       2.2222,
       1024,
       {{1.2e-4, 1e-5}, {3.3e-5, 1e-6}, {4.2e-6, 1e-7}},
       {{1.25e-4, 1e-6}, {2.0e-5, 1e-6}, {2.2e-6, 1e-7}}},
      {1,
       10,
       16,
       {{1.36e-3, 1e-5}, {6.2e-4, 1e-5}, {9.5e-4, 1e-5}},
       {{1.36e-3, 1e-5}, {1.75e-4, 1e-6}, {3.1e-4, 1e-5}}},
      {1,
       10,
       1024,
       {{2.1e-5, 1e-6}, {8.2e-6, 1e-7}, {6.3e-6, 1e-7}},
       {{2.1e-5, 1e-6}, {1.5e-6, 1e-7}, {2.0e-7, 1e-8}}},
      {3,
       6.6667,
       16,
       {{9.5e-4, 1e-5}, {7.2e-4, 1e-5}, {7.9e-4, 1e-5}},
       {{9.6e-4, 1e-5}, {5.3e-4, 1e-5}, {5.6e-4, 1e-5}}},
      {3,
       6.6667,
       1024,
       {{1.46e-5, 1e-7}, {8.4e-6, 1e-7}, {5.0e-6, 1e-7}},
       {{1.45e-5, 1e-7}, {6.2e-6, 1e-7}, {1.5e-6, 1e-7}}}};
  const PatternKind kinds[] = {PatternKind::Independent, PatternKind::LatinHypercube,
                               PatternKind::Hammersley};
  for (const Row& row : rows) {
    const double maximum = ControlledFunction("cosine", 1, 1).maximum();
    const ControlledFunction c("cosine", row.tau, row.depth / (row.tau * maximum));
    const int repetitions = row.count == 1 ? 100000 : row.count == 1024 ? 300 : row.count == 256 ? 800 : 6000;
    for (int k = 0; k < 3; ++k) {
      const auto check = [&](const auto& estimator, const Printed& printed) {
        const auto run = runShared(estimator, c, kinds[k], row.count, repetitions);
        EXPECT_LE(std::abs(run.squares.mean() - printed.value),
                  kMaxAbsZ * run.squares.standardError() + printed.unit)
            << estimator.kName << ", " << kPatternNames[static_cast<std::size_t>(kinds[k])] << ", "
            << row.count << " estimates, " << c.what() << ": "
            << test::zTest(run.squares, printed.value, kSeed);
      };
      check(RatioTracking{}, row.ratio[k]);
      check(PSeriesRatio{}, row.series[k]);
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
