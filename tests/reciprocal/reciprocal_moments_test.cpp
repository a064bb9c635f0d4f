// SPDX-License-Identifier: BSD-2-Clause
// First and second moments of estimators of 1/F and their cost against closed forms and enumerations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fields/canonical_line.h"
#include "reciprocal/any_reciprocal.h"
#include "support/roulette_moments.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::RouletteMoments;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20241122;

struct Sampled {
  RunningStats values, squares, lookups;
};

template <class Estimator>
Sampled sample(const Estimator& estimator, const CanonicalLine& line, int trials) {
  Sampled s;
  Rng rng(kSeed);
  for (int i = 0; i < trials; ++i) {
    SampleStream stream(rng);
    const Estimate<1> e = estimator(line, Channels<1>{1}, stream);
    s.values.add(e.value[0]);
    s.squares.add(e.value[0] * e.value[0]);
    s.lookups.add(static_cast<double>(e.tally.lookups));
  }
  return s;
}

void expectNear(const RunningStats& found, double truth, const std::string& what) {
  EXPECT_LT(std::abs(zTest(found, truth).z()), kMaxAbsZ) << what << ": " << zTest(found, truth, kSeed);
}

/// Moments of the ratio 1 - density / control at one point spread by a constant control, by the midpoint
/// rule.
struct RatioMoments {
  double mean = 0, square = 0, size = 0;

  explicit RatioMoments(const CanonicalLine& line) {
    constexpr int kPoints = 1 << 18;
    const double upper = line.upperIntegral() / line.length();
    for (int i = 0; i < kPoints; ++i) {
      const double r = 1 - line.density((i + .5) / kPoints * line.length()) / upper;
      mean += r / kPoints;
      square += r * r / kPoints;
      size += std::abs(r) / kPoints;
    }
  }
};

TEST(ReciprocalMoments, BernoulliTrialsAreGeometricWhateverTheDensity) {
  for (const char* name : {"constant", "cosine", "gaussian", "piecewise-random"}) {
    for (const double control : {1., 3.}) {
      const CanonicalFunction function = *findCanonicalFunction(name);
      const CanonicalLine line(function, {.control = control, .superVoxels = 4});
      const double f = line.integral(), p = f / line.upperIntegral();
      const std::string what = std::string(name) + ", control " + std::to_string(control);
      for (const bool cumulative : {false, true}) {
        const Sampled s = cumulative ? sample(ReciprocalPCumulative{}, line, 40000)
                                     : sample(ReciprocalBernoulli{}, line, 40000);
        expectNear(s.values, 1 / f, what);
        if (p == 1) {
          EXPECT_NEAR(s.values.variance(), 0, 1e-24) << what;
          continue;
        }
        expectNear(s.squares, (1 + (1 - p)) / (f * f), what);
        expectNear(s.lookups, 1 / p, what);
      }
    }
  }
}

TEST(ReciprocalMoments, PSeriesCumulativeIsBernoulliTrialsForFactorsOfAnySize) {
  const CanonicalFunction function = *findCanonicalFunction("cosine");
  const CanonicalLine line(function, {.control = 1.5});
  const double f = line.integral(), p = f / line.upperIntegral();
  for (const Comb comb : {Comb::Equidistant, Comb::Stratified, Comb::Independent, Comb::GoldenRatio}) {
    const Sampled s = sample(ReciprocalPCumulative{.n = 5, .comb = comb}, line, 40000);
    expectNear(s.values, 1 / f, "mean");
    expectNear(s.squares, (2 - p) / (f * f), "second moment");
    expectNear(s.lookups, 5 / p, "look-ups");
  }
}

TEST(ReciprocalMoments, PSeriesCumulativeUnderALowControlHasThoseOfSignedTerms) {
  const CanonicalFunction function = *findCanonicalFunction("composite-sine");
  const CanonicalLine line(function, {.control = .6});
  const double f = line.integral(), alpha = line.upperIntegral();
  const RatioMoments r(line);
  ASSERT_LT(r.mean, r.size);  // some ratios are negative
  const Sampled s = sample(ReciprocalPCumulative{}, line, 100000);
  expectNear(s.values, 1 / f, "mean");
  expectNear(s.squares, (1 + 2 * r.mean / (1 - r.mean)) / (1 - r.size) / (alpha * alpha), "second moment");
  expectNear(s.lookups, 1 / (1 - r.size), "look-ups");
}

/// The orders of the Taylor series as RouletteMoments asks for them: its coefficients are 1.
struct TaylorOrders {
  ReciprocalTaylor::Orders orders;
  double continuation(std::uint64_t k) const { return orders.continuation(k); }
  double termFactor(std::uint64_t k) const { return 1 / orders.continuation(k); }
};

TEST(ReciprocalMoments, TaylorSeriesHasThoseOfItsProducts) {
  const CanonicalFunction function = *findCanonicalFunction("composite-sine");
  const CanonicalLine line(function, {.control = 1.5});
  const double f = line.integral(), control = line.upperIntegral();
  const RatioMoments atControl(line);
  const double variance = (atControl.square - atControl.mean * atControl.mean) * control * control;  // of F_i
  for (const double pivot : {0., 1.3, .8}) {
    for (const bool symmetric : {false, true}) {
      const ReciprocalTaylor estimator{.pivotDepth = pivot,
                                       .terms = 2,
                                       .correctionProbability = .6,
                                       .continuation = .8,
                                       .symmetrisation = symmetric};
      const double alpha = pivot > 0 ? pivot : control;
      const RouletteMoments moments(TaylorOrders{estimator.orders()});
      const double m = 1 - f / alpha, v = variance / (alpha * alpha);
      const double square =
          (symmetric ? moments.symmetricSecondMoment(m, v) : moments.productSecondMoment(m, v)) /
          (alpha * alpha);
      const Sampled s = sample(estimator, line, 100000);
      const std::string what = "pivot " + std::to_string(alpha) + (symmetric ? ", symmetric" : ", plain");
      expectNear(s.values, 1 / f, what);
      expectNear(s.squares, square, what);
      expectNear(s.lookups, 1 + .6 / (1 - .8), what);
    }
  }
}

TEST(ReciprocalMoments, SymmetricMeansOfTheTaylorSeriesVaryLess) {
  const CanonicalFunction function = *findCanonicalFunction("composite-sine");
  const CanonicalLine line(function, {.control = 1.5});
  const RatioMoments r(line);
  const RouletteMoments moments(TaylorOrders{ReciprocalTaylor{}.orders()}, 200);
  const double v = r.square - r.mean * r.mean;
  EXPECT_LT(moments.symmetricSecondMoment(r.mean, v), moments.productSecondMoment(r.mean, v));
}

struct Moments {
  double mean = 0, square = 0;
};

/// Of one telescoping estimate with equidistant teeth, n = 1 and its base of level k read off the march: the
/// sum over levels, the integral over the one offset by the midpoint rule, written from the definition.
Moments telescopingMoments(const CanonicalLine& line, unsigned k, double rate, bool isPrefix) {
  Moments moments;
  for (unsigned level = 0; level < 10; ++level) {
    const double probability = rate * std::pow(1 - rate, level);
    const int offsets = std::max(64, 2048 >> level);
    const unsigned teeth = 1u << (k + level + 1);
    std::vector<double> density(teeth);
    for (int o = 0; o < offsets; ++o) {
      for (unsigned t = 0; t < teeth; ++t) {
        density[t] = line.density((t + (o + .5) / offsets) / teeth * line.length());
      }
      // Mean of 1/F over the parts that are combs of 2^(k + i) teeth of this one.
      const auto atLevel = [&](unsigned i) {
        const unsigned parts = 1u << (level + 1 - i);
        double sum = 0;
        for (unsigned part = 0; part < parts; ++part) {
          double f = 0;
          for (unsigned t = part; t < teeth; t += parts) f += density[t];
          sum += 1 / (f * line.length() * parts / teeth);
        }
        return sum / parts;
      };
      double value = atLevel(0);
      if (isPrefix) {
        for (unsigned i = 0; i <= level; ++i) {
          value += (atLevel(i + 1) - atLevel(i)) / std::pow(1 - rate, i);
        }
      } else {
        value += (atLevel(level + 1) - atLevel(level)) / probability;
      }
      moments.mean += probability * value / offsets;
      moments.square += probability * value * value / offsets;
    }
  }
  return moments;
}

TEST(ReciprocalMoments, TelescopingHasThoseOfItsLevels) {
  for (const char* name : {"composite-sine", "gaussian-m23"}) {
    const CanonicalFunction function = *findCanonicalFunction(name);
    const CanonicalLine line(function, {});
    for (const bool isPrefix : {false, true}) {
      const ReciprocalTelescoping estimator{.levels = 1,
                                            .correction = isPrefix ? Correction::Prefix : Correction::Single};
      const Moments exact = telescopingMoments(line, 1, estimator.rate, isPrefix);
      EXPECT_NEAR(exact.mean, 1 / line.integral(), 1e-4) << name;
      const Sampled s = sample(estimator, line, 100000);
      expectNear(s.values, 1 / line.integral(), name);
      expectNear(s.squares, exact.square, name);
    }
  }
}

TEST(ReciprocalMoments, AMarchIsBiasedAndItsDebiasedFormsAreNot) {
  const CanonicalFunction function = *findCanonicalFunction("gaussian-m23");
  const CanonicalLine line(function, {});
  const double truth = 1 / line.integral();
  const Sampled march = sample(ReciprocalMarch{.n = 4, .comb = Comb::Independent}, line, 20000);
  EXPECT_GT(zTest(march.values, truth).z(), 10);
  EXPECT_EQ(march.lookups.mean(), 4);
  const Sampled debiased = sample(
      ReciprocalTelescoping{.n = 4, .levels = 0, .comb = Comb::Independent, .reuse = false}, line, 100000);
  expectNear(debiased.values, truth, "debiased");
}

}  // namespace
}  // namespace pbrtmedia
