// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/paired_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "support/contract_line.h"
#include "support/function_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimate_on.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 77;

template <class Line>
PairedEstimate<1> pairedOf(const TwoCombUmvu& estimator, const Line& line, double sigmaT, Rng& rng) {
  SampleStream stream(rng);
  return estimator.paired(line, Channels<1>{sigmaT}, stream);
}

TEST(PairedEstimate, IsTheEstimateForTheSameLookups) {
  for (const double sigma : {.5, 4.}) {
    Rng alone(kSeed), paired(kSeed);
    for (int i = 0; i < 20; ++i) {
      const auto a = test::runEstimator(TwoCombUmvu(), test::ContractLine(), Channels<1>{sigma}, alone);
      const PairedEstimate<1> b = pairedOf(TwoCombUmvu(), test::ContractLine(), sigma, paired);
      EXPECT_EQ(a.value[0], b.value[0]);
      EXPECT_EQ(a.tally.lookups, b.tally.lookups);
      EXPECT_NE(b.spread[0], 0);
    }
  }
}

/// A ramp seen by a comb of M teeth: its depth is uniform within tau / M of tau, so all moments are known.
TEST(PairedEstimate, HasTheMomentsOfARamp) {
  const test::FunctionLine line{[](double s) { return 2 * s; }, {{1, {2, 0}}}};
  for (const int teeth : {1, 2, 4}) {
    for (const double tau : {.5, 2.}) {
      const double d = tau / teeth;
      // E[e^{-a X}]
      const auto generating = [&](std::complex<double> a) {
        return std::exp(-a * tau) * std::sinh(a * d) / (a * d);
      };
      const double mean = std::norm(generating({.5, .5}));
      const double product = std::norm(generating(1.)), cosine = std::norm(generating({1, 1}));
      const double truth = std::exp(-tau);
      const TwoCombUmvu estimator{.endpointMatching = EndpointMatching::Off,
                                  .tupleSize = static_cast<std::uint64_t>(teeth)};
      Rng rng(kSeed);
      RunningStats values, spreads, squaredSpreads, squares;
      for (int i = 0; i < 100000; ++i) {
        const PairedEstimate<1> e = pairedOf(estimator, line, tau, rng);
        values.add(e.value[0]);
        spreads.add(e.spread[0]);
        squaredSpreads.add(e.spread[0] * e.spread[0]);
        squares.add(e.value[0] * e.value[0] - e.spread[0] * e.spread[0]);
      }
      EXPECT_LT(std::abs(zTest(values, mean).z()), kMaxAbsZ) << zTest(values, mean);
      EXPECT_LT(std::abs(zTest(spreads, 0).z()), kMaxAbsZ) << zTest(spreads, 0);
      const auto variance = zTest(squaredSpreads, (product - cosine) / 2);
      EXPECT_LT(std::abs(variance.z()), kMaxAbsZ) << variance;
      EXPECT_LT(std::abs(zTest(squares, cosine).z()), kMaxAbsZ) << zTest(squares, cosine);
      // What it says of T² and of its own variance is right as far as depths are normal.
      if (d > .5) continue;
      EXPECT_NEAR(cosine / (truth * truth), 1, .02);
      EXPECT_NEAR(variance.truth / values.variance(), 1, .1);
    }
  }
}

TEST(PairedEstimate, TraitsSayWhoTellsTheSpread) {
  int telling = 0;
  for (const std::string_view name : estimatorNames()) {
    visitEstimator(
        [&](const auto& estimator) {
          const test::ContractLine line;
          Rng rng(kSeed);
          SampleStream stream(rng);
          constexpr Channels<1> kSigmaT{1};
          const bool tells = requires { estimator.paired(line, kSigmaT, stream); };
          EXPECT_EQ(estimator.traits().tellsSpread, tells) << name;
          telling += tells;
          if (tells) return;
          EXPECT_THROW(pairedOn(estimator, line, kSigmaT, stream), std::logic_error) << name;
        },
        *findEstimator(name));
  }
  EXPECT_GT(telling, 0);
}

}  // namespace
}  // namespace pbrtmedia
