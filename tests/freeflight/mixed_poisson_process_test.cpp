// SPDX-License-Identifier: BSD-2-Clause
#include "freeflight/mixed_poisson_process.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::RunningStats;

constexpr std::uint64_t kSeed = 71;

std::vector<AnyLaw> mixtures() {
  return {ExponentialLaw{},      PinkNoiseLaw{.5},     PinkNoiseLaw{2},    PinkNoiseLaw{0},
          MixtureLaw{.3, .2, 3}, MixtureLaw{.5, 0, 2}, DavisLaw{.8, .5},   DavisLaw{2, .5},
          DavisLaw{.5, .05},     DavisLaw{3, .95},     DavisLaw{1e-3, .7}, DavisLaw{1e-12, .3},
          DavisLaw{100, .3},     DavisLaw{1, 0},       DavisLaw{1, 1}};
}

/// Depths of the points of one process up to `end`, thinned: each stays with probability `share`.
std::vector<double> pointsOf(const AnyLaw& law, double end, double share, SampleStream& stream) {
  MixedPoissonProcess process(law, stream);
  std::vector<double> points;
  for (double depth = process.next(stream); depth < end; depth += process.next(stream)) {
    if (share == 1 || stream.uniform() < share) points.push_back(depth);
    if (points.size() > 2) break;  // more than two is all that is asked
  }
  return points;
}

TEST(MixedPoissonProcess, HasTheCountsThatTheDerivativesOfTheLawAre) {
  // Pr{no point up to F} = g, Pr{one} = -F g', Pr{two} = F^2 g'' / 2, where thinning only changes F.
  constexpr int kN = 60000;
  Rng rng(kSeed);
  SampleStream stream(rng);
  for (const AnyLaw& law : mixtures()) {
    for (const auto& [end, share] : {std::pair{.3, 1.}, {2., 1.}, {20., 1.}, {5., .2}}) {
      std::array<RunningStats, 3> shares;
      for (int n = 0; n < kN; ++n) {
        const std::size_t count = pointsOf(law, end, share, stream).size();
        for (std::size_t k = 0; k < 3; ++k) shares[k].add(count == k ? 1 : 0);
      }
      const double f = end * share, step = 1e-3 * f;
      const double second =
          (collisionDensityOf(law, f - step) - collisionDensityOf(law, f + step)) / (2 * step);
      const double truths[] = {transmittanceOf(law, f), f * collisionDensityOf(law, f), f * f / 2 * second};
      for (std::size_t k = 0; k < 3; ++k) {
        // A probability so small that none was found has no standard error.
        EXPECT_LE(std::abs(shares[k].mean() - truths[k]),
                  kMaxAbsZ * std::sqrt(truths[k] * (1 - truths[k]) / kN) + 5. / kN)
            << nameOf(law) << ", " << k << " points up to " << f << ": " << shares[k].mean() << " instead of "
            << truths[k];
      }
    }
  }
}

TEST(MixedPoissonProcess, SpreadsItsPointsEvenly) {
  // Given how many there are they are independent and uniform: of two, the first is at a third on average.
  Rng rng(kSeed);
  SampleStream stream(rng);
  for (const AnyLaw& law : mixtures()) {
    RunningStats alone, first;
    for (int n = 0; n < 60000; ++n) {
      const std::vector<double> points = pointsOf(law, 2, 1, stream);
      if (points.size() == 1) alone.add(points[0] / 2);
      if (points.size() == 2) first.add(points[0] / 2);
    }
    if (alone.count() > 100) {
      EXPECT_LT(std::abs(test::zTest(alone, .5, kSeed).z()), kMaxAbsZ) << nameOf(law);
    }
    if (first.count() > 100) {
      EXPECT_LT(std::abs(test::zTest(first, 1. / 3, kSeed).z()), kMaxAbsZ) << nameOf(law);
    }
  }
}

TEST(MixedPoissonProcess, IsNotThatOfALawNearby) {
  Rng rng(kSeed);
  SampleStream stream(rng);
  RunningStats none;
  for (int n = 0; n < 60000; ++n) none.add(pointsOf(DavisLaw{2, .5}, 3, 1, stream).empty() ? 1 : 0);
  EXPECT_LT(std::abs(test::zTest(none, DavisLaw{2, .5}(3), kSeed).z()), kMaxAbsZ);
  EXPECT_GT(std::abs(test::zTest(none, DavisLaw{2, .6}(3), kSeed).z()), kMaxAbsZ);
  EXPECT_GT(std::abs(test::zTest(none, DavisLaw{1.8, .5}(3), kSeed).z()), kMaxAbsZ);
  EXPECT_GT(std::abs(test::zTest(none, PinkNoiseLaw{2}(3), kSeed).z()), kMaxAbsZ);
}

TEST(DavisJump, HasTheLaplaceTransformOfTheTiltedMeasure) {
  // E exp(-F x) = h'(depth + F) / h'(depth), h = -log g.
  Rng rng(kSeed);
  SampleStream stream(rng);
  for (const DavisLaw& law : {DavisLaw{.8, .5}, DavisLaw{3, .9}, DavisLaw{50, .2}, DavisLaw{.1, .02}}) {
    const auto slope = [&](double f) { return law.density(f) / law(f); };
    for (const double depth : {.01, .1, 1., 40.}) {
      for (const double f : {.3 * depth, 3 * depth}) {
        RunningStats transform;
        for (int n = 0; n < 20000; ++n) transform.add(std::exp(-f * davisJump(law, depth, stream)));
        EXPECT_LT(std::abs(transform.mean() - slope(depth + f) / slope(depth)),
                  kMaxAbsZ * transform.standardError() + 1e-12)
            << law.correlation << ' ' << law.beta << " at " << depth << " + " << f << ": "
            << test::zTest(transform, slope(depth + f) / slope(depth), kSeed);
      }
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
