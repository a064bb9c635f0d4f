// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/path/transmittance_shares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/warp.h"
#include "fields/density_line.h"
#include "support/function_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimators/ratio_tracking.h"
#include "transmittance/estimators/two_comb_umvu.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20251130;
constexpr double kLight = .2, kScattering = 3;
const TransmittanceShares kShares(kLight, kScattering);

/// An estimate that is one of some values, with what it says of its spread.
struct Outcome {
  double probability, value, spread;
  PairedTransmittance estimate() const {
    return {Rgb(static_cast<float>(value)), Rgb(static_cast<float>(spread))};
  }
};
const std::vector<std::vector<Outcome>> kDistributions = {
    {{1, .3, 0}},                                                             // exact
    {{.25, 1, 0}, {.75, 0, 0}},                                               // a flight
    {{.5, .2, .1}, {.5, .4, -.15}},                                           // knows its spread
    {{.125, -.5, .25}, {.375, .75, -.25}, {.25, 1.5, 0}, {.25, .125, .125}},  // leaves the unit interval
};

double meanOf(const std::vector<Outcome>& of) {
  double mean = 0;
  for (const Outcome& o : of) mean += o.probability * o.value;
  return mean;
}

TEST(IndependentShares, AddUpToTheTransmittanceWhateverTheNoise) {
  for (const auto& distribution : kDistributions) {
    const double truth = meanOf(distribution);
    double lit = 0, scattered = 0, naive = 0;
    for (const Outcome& a : distribution) {
      const double ownShare = 1 - double{kShares.scatteringShare(a.estimate()).r};
      naive += a.probability * (ownShare * a.value + truth * (1 - ownShare));
      scattered += a.probability * truth * double{kShares.scatteringShare(a.estimate()).g};
      for (const Outcome& b : distribution)
        lit += a.probability * b.probability * double{kShares.litThrough(a.estimate(), b.estimate()).b};
    }
    EXPECT_NEAR(lit + scattered, truth, 1e-7) << distribution.size();
    // Negative control: a share of the estimate that it multiplies.
    if (distribution.size() == 1) continue;
    EXPECT_GT(std::abs(naive - truth), 1e-3) << distribution.size();
  }
}

TEST(IndependentShares, AreLessNoisyThanThoseOfDirectionsAlone) {
  // w_l² E[T^²] / light + (1 - w_l)² T / scattering
  for (const auto& distribution : kDistributions) {
    const double truth = meanOf(distribution);
    double square = 0;
    for (const Outcome& o : distribution) square += o.probability * o.value * o.value;
    const double q = square / truth;
    if (q > 1) continue;
    // An estimate that says of itself what is true of all of them: value T, and the spread to match.
    const Outcome all{1, truth, std::sqrt(std::max(0., square - truth * truth))};
    for (const double ratio : {.05, .3, 1., 3., 15.}) {
      const TransmittanceShares shares(1, ratio);
      const double share = double{shares.lightShare(all.estimate()).r};
      EXPECT_NEAR(share, 1 / (1 + ratio * ratio * q * q), 1e-6);
      const auto moment = [&](double w) { return w * w * square + (1 - w) * (1 - w) * truth / ratio; };
      const double alone = 1 / (1 + ratio * ratio), best = 1 / (1 + ratio * q);
      EXPECT_LE(moment(best), moment(share) * (1 + 1e-6));
      if (ratio < 1) continue;
      EXPECT_LE(moment(share), moment(alone) * (1 + 1e-6)) << ratio << ' ' << q;
    }
  }
}

TEST(IndependentShares, OfOneAreThoseOfDirectionsAlone) {
  EXPECT_FLOAT_EQ(kShares.scatteringShare({}).r, powerHeuristic(kScattering, kLight));
  EXPECT_EQ(kShares.scatteringShare({Rgb(), Rgb()}).r, 0);
  EXPECT_EQ(TransmittanceShares::secondMoment(0, 0), 0);
  EXPECT_EQ(TransmittanceShares::secondMoment(0, .5), 1);
  EXPECT_EQ(TransmittanceShares::secondMoment(7, 0), 1);
  EXPECT_DOUBLE_EQ(TransmittanceShares::secondMoment(-.25, 0), .25);
  EXPECT_DOUBLE_EQ(TransmittanceShares::secondMoment(.4, .2), .5);
}

/// The mean over halves with normal depths, by Simpson's rule.
template <class F>
double meanOverNormals(double tau, double deviation, const F& f) {
  const auto half = [&](double a) { return -tau + deviation * a; };
  return test::simpson(
      [&](double a) {
        return test::simpson(
            [&](double b) {
              const PairedTransmittance z{Rgb(static_cast<float>(TwoCombUmvu::combine(half(a), half(b)))),
                                          Rgb(static_cast<float>(TwoCombUmvu::spread(half(a), half(b))))};
              return f(z) * std::exp(-(a * a + b * b) / 2) / (2 * std::numbers::pi);
            },
            -8, 8, 150);
      },
      -8, 8, 150);
}

TEST(JointShares, AreExactForNormalDepths) {
  for (const double deviation : {.05, .1, .2}) {
    for (const double tau : {.5, 3.}) {
      const double t = std::exp(-tau), odds = kScattering * t / kLight;
      const double share = odds * odds / (1 + odds * odds);
      const double lit =
          meanOverNormals(tau, deviation, [](const auto& z) { return double{kShares.jointLitThrough(z).r}; });
      const double scattered = meanOverNormals(
          tau, deviation, [](const auto& z) { return double{kShares.jointScatteringShare(z).r}; });
      EXPECT_NEAR(lit / (t * (1 - share)), 1, 2e-6) << deviation << ' ' << tau;
      EXPECT_NEAR(scattered / share, 1, 2e-6) << deviation << ' ' << tau;
      if (deviation < .2) continue;
      // Negative control: the same estimate, as if it were exact.
      const double naive = meanOverNormals(tau, deviation, [](const auto& z) {
        return double{kShares.jointLitThrough({z.value, Rgb()}).r};
      });
      EXPECT_GT(std::abs(naive / (t * (1 - share)) - 1), 1e-3) << tau;
    }
  }
}

TEST(JointShares, AddUpToTheValueOfEveryEstimate) {
  for (const auto& distribution : kDistributions) {
    for (const Outcome& o : distribution) {
      const double lit = double{kShares.jointLitThrough(o.estimate()).r};
      EXPECT_TRUE(std::isfinite(lit));
      if (o.spread != 0) continue;
      EXPECT_NEAR(lit + o.value * double{kShares.jointScatteringShare(o.estimate()).r}, o.value, 1e-6)
          << o.value;
    }
  }
  // Halves so far apart that the denominator vanishes.
  const PairedTransmittance pole{Rgb(0), Rgb(static_cast<float>(kLight / kScattering))};
  EXPECT_TRUE(kShares.jointLitThrough(pole).isFinite());
  EXPECT_TRUE(kShares.jointScatteringShare(pole).isFinite());
}

/// A cosine with a bound twice as high: the mean of what light samples and flights find, of real estimates.
template <class Estimate>
void expectUnbiased(const Estimate& estimate, double truth, const char* name) {
  Rng rng(kSeed);
  RunningStats independent, naive;
  for (int i = 0; i < 200000; ++i) {
    const PairedTransmittance a = estimate(rng), b = estimate(rng), c = estimate(rng);
    const double scattered = truth * double{kShares.scatteringShare(c).r};
    independent.add(double{kShares.litThrough(a, b).r} + scattered);
    naive.add(double{kShares.litThrough(a, a).r} + scattered);
  }
  const auto test = zTest(independent, truth, kSeed);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << name << ": " << test;
  EXPECT_TRUE(test.sees()) << name << ": " << test;
  const auto control = zTest(naive, truth, kSeed);
  EXPECT_GT(std::abs(control.z()), kMaxAbsZ) << name << ": " << control;
}

TEST(IndependentShares, OfRealEstimatesAddUpToTheTransmittance) {
  const test::FunctionLine line{[](double s) { return 1 + std::cos(9 * s); }, {{1, {4, 0}}}};
  const double tau = 1.5 * (1 + std::sin(9.) / 9);
  expectUnbiased(
      [&](Rng& rng) {
        const double value = test::runEstimator(RatioTracking(), line, Channels<1>{1.5}, rng).value[0];
        return PairedTransmittance{Rgb(static_cast<float>(value)), Rgb()};
      },
      std::exp(-tau), "ratio");
  // Its own bias is that of its third cumulant: far below a standard error here.
  const TwoCombUmvu combs{.comb = Comb::Stratified, .tupleSize = 6};
  expectUnbiased(
      [&](Rng& rng) {
        SampleStream stream(rng);
        const PairedEstimate<1> e = combs.paired(line, Channels<1>{1.5}, stream);
        return PairedTransmittance{Rgb(static_cast<float>(e.value[0])), Rgb(static_cast<float>(e.spread[0]))};
      },
      std::exp(-tau), "two combs");
}

}  // namespace
}  // namespace pbrtmedia
