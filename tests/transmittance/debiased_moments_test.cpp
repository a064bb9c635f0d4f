// SPDX-License-Identifier: BSD-2-Clause
// Means, variances and decay of the corrections of debiased ray marching.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fields/canonical_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimators/debiased_ray_marching.h"
#include "transmittance/estimators/prefix_debiased_ray_marching.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::runEstimator;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20241122;
constexpr Comb kCombs[] = {Comb::Equidistant, Comb::Stratified, Comb::Independent, Comb::GoldenRatio};

const std::vector<AnyLaw> kLaws{ExponentialLaw{}, PinkNoiseLaw{.8}, DavisLaw{.5, .5}, LinearLaw{4},
                                MixtureLaw{.3, .2, 2}};

template <class Estimator>
void expectMean(const Estimator& estimator, const CanonicalLine& line, double sigma,
                const std::string& what) {
  RunningStats values;
  Rng rng(kSeed);
  for (int i = 0; i < 1500; ++i) values.add(runEstimator(estimator, line, Channels<1>{sigma}, rng).value[0]);
  const double depth = sigma * line.integral(), truth = transmittanceOf(estimator.law, depth);
  const double rounding = depth * 0x1p-45 + 1e-12;  // of sums of doubles
  EXPECT_LE(std::abs(values.mean() - truth), kMaxAbsZ * values.standardError() + rounding)
      << Estimator::kName << ", " << what << ": " << zTest(values, truth, kSeed);
}

TEST(DebiasedMoments, HaveTheMeanOfEveryLawOnEveryFunction) {
  for (const char* name : {"constant", "cosine", "gaussian", "hole", "linear-up", "linear-down", "step"}) {
    const auto function = *findCanonicalFunction(name);
    const CanonicalLine line(function, {});
    for (const double depth : {.05, .5, 2.3, 6.}) {
      const double sigma = depth / line.integral();
      for (const AnyLaw& law : kLaws) {
        for (const Comb comb : kCombs) {
          if (!TelescopingLevels::hasFiniteVariance(comb, TelescopingLevels::kRate, law)) continue;
          std::string what(name);
          what +=
              ", depth " + std::to_string(depth) + ", comb " + std::to_string(static_cast<int>(comb)) + ", ";
          what += nameOf(law);
          expectMean(DebiasedRayMarching{.law = law, .comb = comb}, line, sigma, what);
          expectMean(DebiasedRayMarching{.law = law, .levels = 1, .comb = comb, .reuse = false}, line, sigma,
                     what + ", apart");
          expectMean(PrefixDebiasedRayMarching{.law = law, .comb = comb}, line, sigma, what);
          expectMean(PrefixDebiasedRayMarching{.law = law, .levels = 1, .comb = comb, .reuse = false}, line,
                     sigma, what + ", prefix apart");
        }
      }
    }
  }
}

/// Negative control: the coarse march without its corrections is rejected.
TEST(DebiasedMoments, WouldRejectTheMarchThatIsNotDebiased) {
  const auto function = *findCanonicalFunction("gaussian");
  const CanonicalLine line(function, {});
  RunningStats values;
  Rng rng(kSeed);
  for (int i = 0; i < 3000; ++i) {
    values.add(runEstimator(DebiasedRayMarching{.maxLookups = 4}, line, Channels<1>{2.3}, rng).value[0]);
  }
  EXPECT_GT(std::abs(zTest(values, std::exp(-2.3)).z()), kMaxAbsZ) << zTest(values, std::exp(-2.3), kSeed);
}

struct Moments {
  double mean = 0, square = 0;
};

/// First and second moment of the single-term estimate with equidistant teeth from level 0, its base read off
/// the march: the sum over levels, the integral over the one offset by the midpoint rule. Written from the
/// definition, with all values of a comb at hand.
Moments exactMoments(const CanonicalLine& line, const AnyLaw& law, double sigma, double rate) {
  Moments moments;
  for (int level = 0; level < 13; ++level) {
    const int teeth = 2 << level, offsets = std::max(64, 4096 >> level);
    const double probability = rate * std::pow(1 - rate, level);
    for (int o = 0; o < offsets; ++o) {
      double base = 0, halves[2] = {0, 0};
      for (int t = 0; t < teeth; ++t) {
        const double f =
            sigma * line.density((t + (o + .5) / offsets) * line.length() / teeth) * line.length();
        base += transmittanceOf(law, f) / teeth;
        halves[t & 1] += f / (teeth / 2);
      }
      const double fine = transmittanceOf(law, (halves[0] + halves[1]) / 2);
      const double coarse = (transmittanceOf(law, halves[0]) + transmittanceOf(law, halves[1])) / 2;
      const double value = base + (fine - coarse) / probability;
      moments.mean += probability * value / offsets;
      moments.square += probability * value * value / offsets;
    }
  }
  return moments;
}

TEST(DebiasedMoments, AreThoseOfTheReference) {
  // Experiments of Misso et al. 2022, telescoping from level 0 at T = 0.5, r = 0.65. The reference
  // counts 4.316 look-ups in 2e6 runs; 2 r / (2 r - 1) = 4.333, with infinite variance.
  const struct {
    const char* function;
    AnyLaw law;
    double depth, mse, lastDigit;
  } rows[] = {{"sine", ExponentialLaw{}, std::log(2.), 2.43e-3, 5e-6},
              {"gaussian-m22", ExponentialLaw{}, std::log(2.), .0596, 5e-5},
              {"sine", PinkNoiseLaw{.8}, (std::pow(.5, -.64) - 1) / .64, 3.5e-3, 5e-5}};
  for (const auto& row : rows) {
    const auto function = *findCanonicalFunction(row.function);
    const CanonicalLine line(function, {});
    const double sigma = row.depth / line.integral();
    const Moments exact = exactMoments(line, row.law, sigma, .65);
    EXPECT_NEAR(exact.mean, .5, 1e-6) << row.function;
    // The reference is an average over 2e6 runs, half a per cent for the heavy tails of the Gaussian.
    EXPECT_NEAR(exact.square - .25, row.mse, row.lastDigit + .005 * row.mse) << row.function;
    const DebiasedRayMarching estimator{.law = row.law, .levels = 0};
    RunningStats value, square;
    Rng rng(kSeed);
    for (int i = 0; i < 200000; ++i) {
      const double t = runEstimator(estimator, line, Channels<1>{sigma}, rng).value[0];
      value.add(t);
      square.add(t * t);
    }
    EXPECT_LT(std::abs(zTest(value, .5).z()), kMaxAbsZ) << row.function << ": " << zTest(value, .5, kSeed);
    const auto second = zTest(square, exact.square, kSeed);
    EXPECT_LT(std::abs(second.z()), kMaxAbsZ) << row.function << ": " << second;
  }
}

TEST(DebiasedMoments, HaveTheExactVarianceOnFunctionsWithoutThePeriodOfTheComb) {
  for (const char* name : {"cosine", "linear-up", "hole"}) {
    const auto function = *findCanonicalFunction(name);
    const CanonicalLine line(function, {});
    for (const double rate : {.65, .85}) {
      const Moments exact = exactMoments(line, ExponentialLaw{}, 2, rate);
      RunningStats square;
      Rng rng(kSeed);
      for (int i = 0; i < 100000; ++i) {
        const double t =
            runEstimator(DebiasedRayMarching{.levels = 0, .rate = rate}, line, Channels<1>{2}, rng).value[0];
        square.add(t * t);
      }
      const auto second = zTest(square, exact.square, kSeed);
      EXPECT_LT(std::abs(second.z()), kMaxAbsZ) << name << ", rate " << rate << ": " << second;
    }
  }
}

/// log2 of Var[Delta_j] / Var[Delta_{j+1}], on average over the levels between.
template <class Delta>
double decayPerLevel(unsigned from, unsigned to, Delta&& delta) {
  Rng rng(kSeed);
  const auto varianceAt = [&](unsigned level) {
    RunningStats values;
    for (int i = 0; i < 12000; ++i) values.add(delta(level, rng));
    return values.variance();
  };
  return std::log2(varianceAt(from) / varianceAt(to)) / (to - from);
}

TEST(DebiasedMoments, FallTwiceAsFastPerLevelWithSharedLookups) {
  const auto function = *findCanonicalFunction("cosine");
  const CanonicalLine line(function, {});
  const auto g = [](double column) { return std::exp(-column); };
  const auto march = [&](Comb comb, unsigned level, unsigned splits, Rng& rng) {
    SampleStream stream(rng);
    LookupTally tally;
    std::vector<double> columns;
    NestedMarch(comb, std::uint64_t{1} << level, splits)(line, stream, tally,
                                                         [&](double column) { columns.push_back(column); });
    return columns;
  };
  const auto shared = [&](Comb comb) {
    return [&, comb](unsigned level, Rng& rng) {
      const auto half = march(comb, level, 1, rng);
      return g((half[0] + half[1]) / 2) - (g(half[0]) + g(half[1])) / 2;
    };
  };
  const auto apart = [&](unsigned level, Rng& rng) {
    return g(march(Comb::Independent, level + 1, 0, rng)[0]) - g(march(Comb::Independent, level, 0, rng)[0]);
  };
  // Misso et al. 2022, Fig. 7. The variance of a variance of 12000 values is 1 to 3 %, that is 0.03 in log2.
  EXPECT_NEAR(decayPerLevel(3, 7, apart), 1, .05);
  EXPECT_NEAR(decayPerLevel(3, 7, shared(Comb::Independent)), 2, .05);
  EXPECT_GT(decayPerLevel(3, 7, shared(Comb::Stratified)), 3.5);
  EXPECT_GT(decayPerLevel(3, 7, shared(Comb::Equidistant)), 3.5);
}

}  // namespace
}  // namespace pbrtmedia
