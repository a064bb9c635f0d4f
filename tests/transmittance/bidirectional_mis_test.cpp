// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/bidirectional_mis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "transmittance/estimators/unidirectional_mis.h"
#include "transmittance/series_cases.h"

namespace pbrtmedia {
namespace {

using test::ControlledFunction;
using test::kMaxAbsZ;
using test::runEstimator;

constexpr std::uint64_t kSeed = 20241203;

/// The estimator from its definition, on one interval of one bound: walks first, then for every technique and
/// every set of points it can make f / p with the balance heuristic over all densities, each from the formula
/// of the paper in logarithms.
double byDefinition(const CanonicalLine& line, double sigma, Rng& rng) {
  const double control = sigma * static_cast<double>(line.intervals().front().bound.upper);
  const double depth = control * line.length();
  std::vector<double> fromA, fromB;
  double x = 0, y = depth;
  for (bool walkA = true, walkB = true; walkA || walkB;) {
    if (walkA) {
      x += rng.exponential();
      walkA = x < depth;
      if (walkA) fromA.push_back(x);
    }
    if (walkB) {
      y -= rng.exponential();
      walkB = y > 0;
      if (walkB) fromB.push_back(y);
    }
  }
  const auto null = [&](double at) {
    return 1 - sigma * static_cast<double>(line.density(at / control)) / control;
  };
  // Score of the points, sorted, of whichever technique made them: f over the sum of all densities. Both lack
  // the product of the controls and 1/k!.
  const auto score = [&](const std::vector<double>& points) {
    const std::size_t k = points.size();
    const auto at = [&](std::size_t i) { return i == 0 ? 0 : i > k ? depth : points[i - 1]; };
    double product = 1, densities = std::exp(-depth);  // ratio tracking from a
    for (const double p : points) product *= null(p);
    for (std::size_t t = 0; t <= k; ++t) densities += std::exp(-at(t) - (depth - at(t + 1)));
    return std::exp(-depth) * product / densities;
  };
  double sum = score(fromA);
  for (std::size_t t = 0; t <= fromA.size(); ++t) {
    for (std::size_t s = 0; s <= fromB.size(); ++s) {
      const double lastA = t == 0 ? 0 : fromA[t - 1], lastB = s == 0 ? depth : fromB[s - 1];
      if (!(lastA < lastB)) continue;
      std::vector<double> points(fromA.begin(), fromA.begin() + static_cast<std::ptrdiff_t>(t));
      for (std::size_t i = s; i-- > 0;) points.push_back(fromB[i]);
      sum += score(points);
    }
  }
  return sum;
}

TEST(BidirectionalMis, IsItsDefinitionForTheSameWalks) {
  for (const auto& c : {ControlledFunction("cosine", .5, 1), ControlledFunction("linear-up", 6, 2),
                        ControlledFunction("gaussian", 2, 1), ControlledFunction("step", 3, .4)}) {
    const CanonicalLine line = c.line();
    Rng a(kSeed), b(kSeed);
    for (int i = 0; i < 40; ++i) {
      const double value = runEstimator(BidirectionalMis{}, line, Channels<1>{c.sigma()}, a).value[0];
      const double truth = byDefinition(line, c.sigma(), b);
      ASSERT_NEAR(value, truth, 1e-7 * std::abs(truth)) << c.what();  // densities are rounded to float
    }
  }
}

TEST(BidirectionalMis, SpendsTwiceTheOpticalDepthOfItsBound) {
  for (const auto& c : {ControlledFunction("cosine", 1, 1), ControlledFunction("hole", 2, 3)}) {
    const auto run = test::runMany(BidirectionalMis{}, c.line(), c.sigma(), 0, 20000, kSeed);
    const auto cost = test::zTest(run.lookups, 2 * c.depth(), kSeed);
    EXPECT_LT(std::abs(cost.z()), kMaxAbsZ) << c.what() << ": " << cost;
  }
}

TEST(BidirectionalMis, LeavesOutNothingThatASumOverAllPairsWouldHold) {
  // Looser bounds: thousands of pairs, most of them left out.
  const ControlledFunction c("cosine", 1, 60);
  const CanonicalLine line = c.line();
  Rng a(kSeed), b(kSeed);
  for (int i = 0; i < 2; ++i) {
    const double value = runEstimator(BidirectionalMis{}, line, Channels<1>{1}, a).value[0];
    const double truth = byDefinition(line, 1, b);
    ASSERT_NEAR(value, truth, 1e-7 * truth);
  }
}

TEST(BidirectionalMis, DoesNotMindTheDirectionOfTheRamp) {
  // Mirrored media look alike to it but for the ratio tracking share, unlike to a walk from one end.
  const ControlledFunction up("linear-up", 2, 1), down("linear-down", 2, 1);
  const double truth = std::exp(-2);
  const auto both = [&](auto estimator) {
    const auto a = test::runMany(estimator, up.line(), 2, truth, 40000, kSeed);
    const auto b = test::runMany(estimator, down.line(), 2, truth, 40000, kSeed);
    return b.value.variance() / a.value.variance();
  };
  EXPECT_LT(both(BidirectionalMis{}), 1.5);
  EXPECT_GT(both(UnidirectionalMis{}), 2);
}

}  // namespace
}  // namespace pbrtmedia
