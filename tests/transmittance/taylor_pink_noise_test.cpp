// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/taylor_pink_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fields/canonical_line.h"
#include "support/contract_line.h"
#include "support/function_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::runEstimator;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20241122;

double reaching(const TaylorRoulette& roulette, std::uint64_t order) {
  double p = 1;
  for (std::uint64_t j = 1; j <= order; ++j) p *= roulette.continuation(j);
  return p;
}
double sumAbout(const TaylorRoulette& roulette, double pivot, const std::vector<double>& columns,
                double sigma) {
  double out = 0;
  roulette.sumAbout(pivot, columns, std::span(&sigma, 1), std::span(&out, 1));
  return out;
}
/// E[value^power] in a medium whose marches all find `column`, by enumeration of N up to `most`:
/// sum over n of P_n (value_n^power - value_{n-1}^power).
double enumerated(const TaylorRoulette& roulette, double pivot, double column, int power,
                  std::uint64_t most) {
  double sum = 0, before = 0;
  for (std::uint64_t n = 0; n <= most && reaching(roulette, n) > 1e-200; ++n) {
    const double value = std::pow(sumAbout(roulette, pivot, std::vector(n, column), 1), power);
    sum += reaching(roulette, n) * (value - before);
    before = value;
  }
  return sum;
}

TEST(TaylorRoulette, AlwaysGoesToOrderTwoAndInOneOfTenCasesBeyond) {
  const TaylorRoulette roulette{PinkNoiseLaw{.8}};
  EXPECT_EQ(roulette.continuation(1), 1);
  EXPECT_EQ(roulette.continuation(2), 1);
  EXPECT_EQ(roulette.continuation(3), .1);
  EXPECT_DOUBLE_EQ(roulette.continuation(4), (1 + 3 * .64) / 4);
  EXPECT_DOUBLE_EQ(roulette.continuation(10), (1 + 9 * .64) / 10);
  EXPECT_EQ(roulette.draw(1), 2u);
  EXPECT_EQ(roulette.draw(.1001), 2u);
  EXPECT_EQ(roulette.draw(.1), 3u);
  EXPECT_EQ(roulette.draw(.1 * .7301), 3u);
  EXPECT_EQ(roulette.draw(.1 * .7299), 4u);
  EXPECT_EQ(TaylorRoulette({PinkNoiseLaw{.8}, 1, .3}).draw(.31), 0u);
  EXPECT_EQ(TaylorRoulette({PinkNoiseLaw{.8}, 1, .3}).draw(.3), 1u);
}

TEST(TaylorRoulette, EndsForEveryCorrelation) {
  for (const double c : {0., .1, .99, 1., 30., 1e3}) {
    const TaylorRoulette roulette{PinkNoiseLaw{c}};
    EXPECT_LT(roulette.draw(0x1p-53), 353u) << c;
    double sum = 0;
    for (std::uint64_t j = 1; j < 400; ++j) sum += reaching(roulette, j);
    EXPECT_NEAR(roulette.expectedOrder(), sum, 1e-12) << c;
    EXPECT_LT(roulette.expectedOrder(), 2 + .1 / (1 - TaylorRoulette::kMostContinuation) + 1e-12) << c;
  }
}

TEST(TaylorRoulette, HasTheMeanOfTheLawInsideTheRangeOfTheSeries) {
  for (const double c : {0., .3, .5, .8, .97, 1., 1.3}) {
    const PinkNoiseLaw law{c};
    for (const TaylorRoulette roulette : {TaylorRoulette{law}, TaylorRoulette{law, 1, .5}}) {
      for (const double pivot : {.2, 4.}) {
        const double end = c > 0 ? 2 * pivot + 1 / (c * c) : 3 * pivot;
        for (const double share : {0., .1, .5, .7}) {
          const double mean = enumerated(roulette, pivot, share * end, 1, 160);
          EXPECT_NEAR(mean, law(share * end), 1e-9)
              << "C " << c << ", pivot " << pivot << ", share " << share;
        }
      }
    }
  }
}

/// Negative control for the sign of odd terms: with (F - alpha)^j the mean would be g(2 alpha - F).
TEST(TaylorRoulette, TellsTheTwoSidesOfThePivotApart) {
  const PinkNoiseLaw law{.8};
  const double pivot = 2, depth = 2.7;
  const double mean = enumerated(TaylorRoulette{law}, pivot, depth, 1, 120);
  EXPECT_NEAR(mean, law(depth), 1e-9);
  EXPECT_GT(std::abs(mean - law(2 * pivot - depth)), .05);
}

TEST(TaylorRoulette, HasNoMeanBeyondTheRangeOfTheSeries) {
  const double c = .8, pivot = .5, end = 2 * pivot + 1 / (c * c);
  const TaylorRoulette roulette{PinkNoiseLaw{c}};
  double before = 0;
  for (const std::uint64_t most : {40u, 80u, 160u, 320u}) {
    const double error = std::abs(enumerated(roulette, pivot, 1.2 * end, 1, most));
    EXPECT_GT(error, 4 * before) << most;
    before = error;
  }
  EXPECT_GT(before, 1e6);
}

TEST(TaylorRoulette, HasAFiniteSecondMomentExactlyBelowItsLimit) {
  const double c = .8, pivot = 1, limit = 1 / c + pivot * c;  // of |alpha - F|
  const TaylorRoulette roulette{PinkNoiseLaw{c}};
  const auto momentAt = [&](double difference, std::uint64_t most) {
    return enumerated(roulette, pivot, pivot + difference, 2, most);
  };
  EXPECT_NEAR(momentAt(.8 * limit, 150), momentAt(.8 * limit, 300), 1e-6 * momentAt(.8 * limit, 300));
  EXPECT_GT(momentAt(1.1 * limit, 300), 1e3 * momentAt(1.1 * limit, 150));
}

TEST(TaylorRoulette, TakesEachColumnForThePivotOnce) {
  const TaylorRoulette roulette{PinkNoiseLaw{.6}};
  const std::vector<double> columns{.5, 1.25, .75, 2, 1};
  const Channels<2> sigma{.7, 1.5};
  Channels<2> found;
  roulette.sumAboutEach(columns, sigma, found);
  for (std::size_t c = 0; c < 2; ++c) {
    double expected = 0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      std::vector<double> others = columns;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      expected += sumAbout(roulette, columns[i], others, sigma[c]) / static_cast<double>(columns.size());
    }
    EXPECT_NEAR(found[c], expected, 1e-13);
  }
  std::vector<double> other{2, .5, 1, .75, 1.25};
  Channels<2> permuted;
  roulette.sumAboutEach(other, sigma, permuted);
  for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(found[c], permuted[c], 1e-13);
}

TEST(TaylorRoulette, PlainSeriesTakesTheFirstColumnForThePivot) {
  const TaylorRoulette plain{.function = PinkNoiseLaw{.6}, .isSymmetrised = false};
  const std::vector<double> columns{.5, 1.25, .75, 2};
  double found = 0, one = 1;
  plain.sumAboutEach(columns, std::span(&one, 1), std::span(&found, 1));
  // c_j (F_2 - F_1) .. (F_{j+1} - F_1) / P_j, by hand: c_0 = g, c_j = c_{j-1} taylorRatio.
  const PinkNoiseLaw law{.6};
  double weight = law(.5), expected = weight;
  for (std::size_t j = 1; j < columns.size(); ++j) {
    weight *= law.taylorRatio(.5, static_cast<double>(j)) * (columns[j] - .5) / plain.continuation(j);
    expected += weight;
  }
  EXPECT_NEAR(found, expected, 1e-14);
}

TEST(TaylorRoulette, StaysFiniteWhereTermsOrTheLawLeaveTheRangeOfDouble) {
  for (const double c : {0., 1e-3, .5, 2.}) {
    const TaylorRoulette roulette{PinkNoiseLaw{c}};
    for (const double sigma : {1e-300, 1e-8, 1., 1e6}) {
      for (const double spread : {0., 1e-3, 1.}) {
        double out = 0;
        roulette.sumAboutEach(std::vector{1., 1 + spread, 1 - spread, 1.}, std::span(&sigma, 1),
                              std::span(&out, 1));
        EXPECT_TRUE(std::isfinite(out)) << c << " " << sigma << " " << spread;
      }
    }
  }
}

TEST(TaylorPinkNoise, IsExactInConstantMediaAboutASampledPivot) {
  const auto function = *findCanonicalFunction("constant");
  const CanonicalLine line(function, {.length = 2, .scale = .75});
  Rng rng(kSeed);
  for (const double c : {0., .3, .8, 2.}) {
    for (const double sigma : {1e-8, 1., 50., 1e6}) {
      const PinkNoiseLaw law{c};
      for (int i = 0; i < 30; ++i) {
        EXPECT_NEAR(runEstimator(TaylorPinkNoise{.law = law}, line, Channels<1>{sigma}, rng).value[0],
                    law(1.5 * sigma), 1e-12);
      }
    }
  }
}

TEST(TaylorPinkNoise, CostsItsMarches) {
  const auto function = *findCanonicalFunction("cosine");
  const CanonicalLine line(function, {.length = 3.1});
  const TaylorPinkNoise sampled, fixed{.pivot = Pivot::Fixed}, limited{.maxLookups = 3};
  const auto costOf = [&](const TaylorPinkNoise& estimator, double expected) {
    const auto test = test::runZTest(
        [&](Rng& rng) {
          return static_cast<double>(runEstimator(estimator, line, Channels<1>{1}, rng).tally.lookups);
        },
        expected, kSeed, 20000);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  };
  const double order = sampled.roulette().expectedOrder();
  costOf(sampled, 16 * (order + 1));  // ceil(3.1 / 0.2) teeth
  costOf(fixed, 16 * order);
  costOf(limited, 3 * (order + 1));
}

TEST(TaylorPinkNoise, IsUnbiasedWithinItsRange) {
  for (const char* name : {"cosine", "linear-up", "hole", "step"}) {
    const auto function = *findCanonicalFunction(name);
    const CanonicalLine line(function, {.control = 1.2});
    for (const double c : {.3, .8}) {
      const PinkNoiseLaw law{c};
      for (const double sigma : {.5, 1.}) {
        // The upper end of alpha + 1/C^2 is never met: marches lie within [0, 2.5] at these depths.
        for (const Pivot pivot : {Pivot::Sampled, Pivot::Majorant, Pivot::Fixed}) {
          // 7 steps, none of which ends at the jump.
          const TaylorPinkNoise estimator{.law = law, .stepSize = .15, .pivot = pivot, .pivotDepth = 1.5};
          const auto test = test::runZTest(
              [&](Rng& rng) { return runEstimator(estimator, line, Channels<1>{sigma}, rng).value[0]; },
              law(sigma * line.integral()), kSeed, 8000);
          EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << name << ", C " << c << ", sigma " << sigma << ", pivot "
                                                  << static_cast<int>(pivot) << ": " << test;
        }
      }
    }
  }
}

/// The plain series of the papers' comparisons: symmetrised, it has about half of the variance.
TEST(TaylorPinkNoise, PlainSeriesIsUnbiasedAndVariesMore) {
  const auto function = *findCanonicalFunction("cosine");
  const CanonicalLine line(function, {});
  const PinkNoiseLaw law{.8};
  RunningStats values[2];
  for (const bool symmetric : {false, true}) {
    Rng rng(kSeed);
    const TaylorPinkNoise estimator{.law = law, .symmetrisation = symmetric};
    for (int i = 0; i < 100000; ++i) {
      values[symmetric].add(runEstimator(estimator, line, Channels<1>{1}, rng).value[0]);
    }
    const auto test = zTest(values[symmetric], law(line.integral()));
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  }
  EXPECT_GT(values[0].variance(), 1.2 * values[1].variance());
}

/// Negative control: outside its range estimates are visibly off, and single ones as large as can be.
TEST(TaylorPinkNoise, BreaksDownOutsideItsRange) {
  const auto function = *findCanonicalFunction("constant");
  const CanonicalLine line(function, {});
  const TaylorPinkNoise estimator{.law = {.8}, .pivot = Pivot::Fixed, .pivotDepth = .1};
  EXPECT_FALSE(estimator.traits().finiteVariance);
  EXPECT_FALSE(estimator.traits().biasNote.empty());
  Rng rng(kSeed);
  double largest = 0;
  for (int i = 0; i < 20000; ++i) {
    const double value = runEstimator(estimator, line, Channels<1>{8}, rng).value[0];  // 8 > 0.2 + 1/0.64
    largest = std::max(largest, std::abs(value));
  }
  EXPECT_GT(largest, 1e6);
}

}  // namespace
}  // namespace pbrtmedia
