// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/poisson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/rng.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;

constexpr std::uint64_t kSeed = 20260719;

/// The probabilities of 0 ... n-1 in long double, from the recursion p_k = p_(k-1) mean / k.
std::vector<long double> recursion(long double mean, std::size_t n) {
  std::vector<long double> p(n);
  for (std::size_t k = 0; k < n; ++k) p[k] = k == 0 ? std::exp(-mean) : p[k - 1] * mean / k;
  return p;
}

TEST(Poisson, FollowsTheRecursionOfItsProbabilities) {
  for (const double mean : {1e-8, .05, .7, 1., 2.3, 11.9, 15.999, 16., 40., 333.3, 5000.}) {
    const auto checked = static_cast<std::size_t>(mean + 12 * std::sqrt(mean) + 30);
    const std::size_t n = 2 * checked + 60;  // the rest is beyond any digit of the tails checked
    const auto p = recursion(mean, n);
    std::vector<long double> tail(n + 1, 0);
    for (std::size_t k = n; k-- > 0;) tail[k] = tail[k + 1] + p[k];
    long double cdf = 0;
    for (std::size_t k = 0; k < checked; ++k) {
      cdf += p[k];
      if (p[k] < 1e-290L) continue;
      EXPECT_NEAR(poissonPmf(k, mean) / static_cast<double>(p[k]), 1, 1e-12) << mean << ' ' << k;
      EXPECT_NEAR(poissonCdf(k, mean) / static_cast<double>(cdf), 1, 1e-11) << mean << ' ' << k;
      if (tail[k] > 1e-280L) {
        EXPECT_NEAR(poissonTail(k, mean) / static_cast<double>(tail[k]), 1, 1e-11) << mean << ' ' << k;
      }
    }
  }
}

TEST(Poisson, IsACertaintyOfNothingAtMeanZero) {
  EXPECT_EQ(poissonPmf(0, 0), 1);
  EXPECT_EQ(poissonPmf(1, 0), 0);
  EXPECT_EQ(poissonPmf(20, 0), 0);
  EXPECT_EQ(poissonCdf(0, 0), 1);
  EXPECT_EQ(poissonTail(0, 0), 1);
  EXPECT_EQ(poissonTail(1, 0), 0);
  EXPECT_EQ(poissonQuantile(.999, 0), 0u);
}

TEST(Poisson, SumsAndExpansionForLargeParametersJoin) {
  // Both sides of the switch at a mean of 1e6: the distribution function differs by its derivative, -pmf.
  for (const int sigmas : {-35, -9, -3, -1, 0, 1, 2, 5, 9, 35}) {
    const auto k = static_cast<std::uint64_t>(1000000 + 1000 * sigmas);
    const double below = 1e6 - .001, above = 1e6;
    const double slope = poissonPmf(k, 1e6 - .0005) * .001;
    if (sigmas < 0) {
      EXPECT_NEAR((poissonCdf(k, below) - slope) / poissonCdf(k, above), 1, 1e-9) << sigmas;
    } else {
      EXPECT_NEAR((poissonTail(k + 1, below) + slope) / poissonTail(k + 1, above), 1, 1e-9) << sigmas;
    }
  }
}

TEST(Poisson, AddsUpToOneAtAnyMean) {
  for (const double mean : {1e-8, .3, 7., 100., 1e5, 999999., 1e6, 1e7, 1e9, 1e12}) {
    for (const double sigmas : {-20., -5., -1., -.01, 0., .01, 1., 5., 20.}) {
      const double at = mean + sigmas * std::sqrt(mean);
      if (at < 0) continue;
      const auto k = static_cast<std::uint64_t>(at);
      EXPECT_NEAR(poissonCdf(k, mean) + poissonTail(k + 1, mean), 1, 1e-12) << mean << ' ' << sigmas;
      EXPECT_NEAR(poissonCdf(k + 1, mean) - poissonCdf(k, mean), poissonPmf(k + 1, mean), 1e-13)
          << mean << ' ' << sigmas;
    }
  }
}

TEST(Poisson, QuantileIsTheFirstCountAboveU) {
  for (const double mean : {1e-8, 1e-3, .5, 3., 15.99, 16., 250., 9e5, 1.1e6, 1e9, 1e12}) {
    for (const double u : {0., 1e-14, 1e-9, .001, .2, .5, .9, .99, 1 - 1e-9, 1 - 1e-12}) {
      const std::uint64_t k = poissonQuantile(u, mean);
      // The distribution function carries a rounding of some 1e-16 a term.
      EXPECT_GT(poissonCdf(k, mean), u - 1e-12) << mean << ' ' << u;
      if (k > 0) {
        EXPECT_LE(poissonCdf(k - 1, mean), u + 1e-12) << mean << ' ' << u;
      }
    }
  }
}

TEST(Poisson, QuantileEndsAtBothEndsOfTheUnitInterval) {
  for (double mean = 1e-300; mean < 1e18; mean *= 7) {
    const double last = static_cast<double>(poissonQuantile(0x1.fffffffffffffp-1, mean));
    const double first = static_cast<double>(poissonQuantile(0, mean));
    EXPECT_LE(first, mean) << mean;
    EXPECT_GE(last + 1, mean) << mean;
    EXPECT_LT(last, mean + 12 * std::sqrt(mean) + 30) << mean;
    EXPECT_GT(first, mean - 45 * std::sqrt(mean) - 1) << mean;
  }
}

TEST(Poisson, UniformNumbersGiveItsCounts) {
  for (const double mean : {.05, 2.3, 15.5, 16.5, 80.}) {
    const auto bins = static_cast<std::size_t>(mean + 10 * std::sqrt(mean) + 10);
    const double n = 200000;
    std::vector<double> observed(bins, 0), expected(bins);
    Rng rng(kSeed);
    for (double i = 0; i < n; ++i) ++observed.at(poissonQuantile(rng.uniformDouble(), mean));
    for (std::size_t k = 0; k < bins; ++k) expected[k] = n * poissonPmf(k, mean);
    const auto counts = test::chiSquareTest(observed, expected);
    EXPECT_GT(counts.pValue(), test::kMinPValue) << mean << ": " << counts;
    // Negative control: a mean 3 % off is seen.
    for (std::size_t k = 0; k < bins; ++k) expected[k] = n * poissonPmf(k, 1.03 * mean + .01);
    EXPECT_LT(test::chiSquareTest(observed, expected).pValue(), test::kMinPValue) << mean;
  }
}

TEST(Poisson, LargeMeansHaveTheRightMeanVarianceAndSkewness) {
  for (const double mean : {2e4, 3e6, 1e9}) {
    Rng rng(kSeed);
    test::RunningStats first, second, third;
    for (int i = 0; i < 100000; ++i) {
      const double d =
          (static_cast<double>(poissonQuantile(rng.uniformDouble(), mean)) - mean) / std::sqrt(mean);
      first.add(d);
      second.add(d * d);
      third.add(d * d * d);
    }
    const auto one = test::zTest(first, 0, kSeed), two = test::zTest(second, 1, kSeed),
               three = test::zTest(third, 1 / std::sqrt(mean), kSeed);
    EXPECT_LT(std::abs(one.z()), kMaxAbsZ) << mean << ": " << one;
    EXPECT_LT(std::abs(two.z()), kMaxAbsZ) << mean << ": " << two;
    EXPECT_LT(std::abs(three.z()), kMaxAbsZ) << mean << ": " << three;
  }
}

}  // namespace
}  // namespace pbrtmedia
