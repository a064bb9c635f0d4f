// SPDX-License-Identifier: BSD-2-Clause
// The gamma trick over every exponential estimator.
#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "fields/canonical_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::runEstimator;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20241122;

TEST(GammaMeans, AreThoseOfPinkNoiseOverEveryUnbiasedBase) {
  const auto function = *findCanonicalFunction("linear-up");
  const CanonicalLine line(function, {.control = 1.2, .superVoxels = 3});
  for (const std::string_view name : alternativeNames<AnyExponentialEstimator>()) {
    for (const double c : {.3, .8}) {
      const PinkNoiseLaw law{c};
      Gamma gamma{.law = law};
      ASSERT_FALSE(gamma.assign("base", std::string(name)).error);
      const EstimatorTraits traits = gamma.traits();
      if (traits.bias != EstimatorTraits::Bias::Unbiased) continue;
      // Bases whose variance grows with gamma have heavy tails where gamma has.
      if (!traits.finiteVariance && c > .5) continue;
      RunningStats values[3];
      Rng rng(kSeed);
      const Channels<3> sigma{.2, 1, 2};
      for (int i = 0; i < 20000; ++i) {
        const auto estimate = runEstimator(gamma, line, sigma, rng);
        for (std::size_t k = 0; k < 3; ++k) values[k].add(estimate.value[k]);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const auto test = zTest(values[k], law(sigma[k]), kSeed);
        EXPECT_LE(std::abs(test.mean - test.truth), kMaxAbsZ * test.standardError + 1e-6)
            << name << ", C " << c << ", sigma " << sigma[k] << ": " << test;
      }
    }
  }
}

/// Negative control: the mean of exponentials is not the exponential of the mean.
TEST(GammaMeans, AreToldApartFromTheExponentialLaw) {
  const auto function = *findCanonicalFunction("linear-up");
  const CanonicalLine line(function, {});
  RunningStats values;
  Rng rng(kSeed);
  for (int i = 0; i < 20000; ++i) {
    values.add(runEstimator(Gamma{.law = {.3}}, line, Channels<1>{2}, rng).value[0]);
  }
  EXPECT_GT(std::abs(zTest(values, std::exp(-2)).z()), kMaxAbsZ) << zTest(values, std::exp(-2), kSeed);
}

}  // namespace
}  // namespace pbrtmedia
