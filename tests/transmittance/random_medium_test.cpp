// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/random_medium.h"

#include <gtest/gtest.h>

#include "tracking_cases.h"
#include "transmittance/estimators/residual_ratio_tracking.h"

namespace pbrtmedia {
namespace {

using namespace test;

constexpr std::uint64_t kSeed = 20261105;

/// The central ray of the analytic medium of Szirmay-Kalos et al. 2017, Eq. (21).
double analytic(double z) { return std::pow((std::cos(1.5 * z) + 1) / 2, 5) * (std::sin(z / 2) + 2) / 3; }
constexpr double kLength = 20;

ProvenLine centralRay() { return {{analytic, {{kLength, {1, 0}}}}}; }

TEST(ExploredControl, InterpolatesBetweenItsExplorers) {
  const ProvenLine line{{[](double x) { return x * x; }, {{1, {2, 0}}, {4, {20, 0}}}}};
  const BoundProfile profile(line);
  LookupTally tally;
  const ExploredControl control(line, profile, 5, tally);  // at 0, 1, 2, 3, 4
  EXPECT_EQ(tally.lookups, 5u);
  EXPECT_EQ(control.largestError(), 1);  // (a^2 + (a + 2)^2) / 2 - (a + 1)^2
  std::vector<ExploredControl::Stretch> all;
  EXPECT_TRUE(control.stretches(.5, 3.25, [&](const auto& stretch) {
    all.push_back(stretch);
    return true;
  }));
  ASSERT_EQ(all.size(), 4u);
  const double a[] = {.5, 1, 2, 3}, b[] = {1, 2, 3, 3.25}, enter[] = {.5, 1, 4, 9}, exit[] = {1, 4, 9, 10.75};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(all[i].a, a[i]);
    EXPECT_EQ(all[i].b, b[i]);
    EXPECT_DOUBLE_EQ(all[i].enter, enter[i]);
    EXPECT_DOUBLE_EQ(all[i].exit, exit[i]);
  }
  EXPECT_FALSE(control.stretches(0, 4, [](const auto&) { return false; }));
}

TEST(ExploredControl, IntegratesWithinItsBounds) {
  Rng rng(kSeed);
  for (int i = 0; i < 500; ++i) {
    const double a = rng.uniformDouble(), lower = rng.uniformDouble(), upper = lower + rng.uniformDouble();
    const ExploredControl::Stretch s{a, a + .5 + rng.uniformDouble(), 2 * rng.uniformDouble(),
                                     i % 7 == 0 ? .7 : 2 * rng.uniformDouble()};
    const double exact = simpson([&](double x) { return s.at(x, lower, upper); }, s.a, s.b, 2000);
    ASSERT_NEAR(s.integral(lower, upper), exact, 1e-6) << i;
  }
}

TEST(ExploredControl, KnowsWithoutLookingWhereBoundsAreTight) {
  const ProvenLine line{{[](double) { return 9.; }, {{1, {0, 0}}, {2, {3, 3}}, {4, {20, 0}}}}};
  const BoundProfile profile(line);
  LookupTally tally;
  const ExploredControl control(line, profile, 9, tally);  // every half
  EXPECT_EQ(tally.lookups, 4u);                            // at 2.5, 3, 3.5, 4
}

TEST(RandomMedium, KnowsTheNumbersOfTheCentralRay) {
  const double tau = simpson(analytic, 0, kLength),
               square = simpson([](double z) { return analytic(z) * analytic(z); }, 0, kLength);
  EXPECT_NEAR(tau, 3.415684, 5e-7);
  EXPECT_NEAR(std::exp(-tau), 3.28539e-2, 5e-8);
  EXPECT_NEAR(square, 1.960753, 5e-7);
  const double variances[][2] = {{.4, 1.441e-1}, {.5, 5.340e-2}, {.6, 2.726e-2}, {.7, 1.669e-2},
                                 {.8, 1.144e-2}, {1, 6.589e-3},  {2, 1.798e-3}};
  for (const auto& [rate, variance] : variances) {
    EXPECT_NEAR(std::exp(-2 * tau) * std::expm1(square / rate) / variance, 1, 5e-4) << rate;
  }
}

TEST(RandomMedium, HasTheVarianceAndCostOfTheCentralRay) {
  const double tau = simpson(analytic, 0, kLength),
               square = simpson([](double z) { return analytic(z) * analytic(z); }, 0, kLength);
  for (const double rate : {.8, 1., 2.}) {
    const Moments m =
        measure(RandomMedium{.explorers = 0, .samplingExtinction = rate}, centralRay(), 1, 20000, kSeed);
    const std::string what = "central ray at " + std::to_string(rate);
    expectMean(m.value, std::exp(-tau), kSeed, what);
    expectMean(m.square, std::exp(-2 * tau + square / rate), kSeed, what + ", squares");
    expectMean(m.lookups, kLength * rate, kSeed, what + ", look-ups");
  }
}

/// The local weight w of a particle with albedo a: the second moment grows like exp(integral of w - 2
/// sigma_diff).
double localWeight(Particle particle, double a, double diff, double rate) {
  const double r = diff / rate;
  const bool isValid = a * r + std::abs(1 - r) <= 1;
  const double nonTerminating = std::abs(diff) * (std::abs(r) + a * std::abs(1 - r));
  switch (particle) {
    case Particle::Double:
      return diff * r;
    case Particle::NonTerminating:
      return nonTerminating;
    case Particle::Terminating:
      return !isValid ? nonTerminating : r <= 1 ? diff : diff * (3 - 2 / r);
    case Particle::Adaptive:
      return r < 1 || !isValid ? nonTerminating : diff * (3 - 2 / r);
  }
  return 0;
}

TEST(RandomMedium, SingleParticlesHaveTheirLocalWeights) {
  const double tau = simpson(analytic, 0, kLength);
  for (const Particle particle : {Particle::Terminating, Particle::NonTerminating, Particle::Adaptive}) {
    for (const double rate : {.7, .9, 1.2}) {
      const double albedo = .7;
      const double w =
          simpson([&](double z) { return localWeight(particle, albedo, analytic(z), rate); }, 0, kLength);
      const Moments m = measure(
          RandomMedium{
              .explorers = 0, .samplingExtinction = rate, .particle = particle, .particleAlbedo = albedo},
          centralRay(), 1, 40000, kSeed);
      const std::string what =
          "particle " + std::to_string(static_cast<int>(particle)) + ", rate " + std::to_string(rate);
      expectMean(m.value, std::exp(-tau), kSeed, what);
      expectMean(m.square, std::exp(-2 * tau + w), kSeed, what + ", squares");
    }
  }
}

TEST(RandomMedium, SingleParticlesServeEveryChannel) {
  const Channels<3> sigma{0, 2, .3};
  const TrackingCase c = trackingCase(shape("cosine"), 1, 1.1, 4, .5);
  for (const Particle particle : {Particle::Terminating, Particle::NonTerminating, Particle::Adaptive}) {
    Rng rng(kSeed);
    RunningStats values[3];
    for (int i = 0; i < 20000; ++i) {
      const auto estimate =
          runEstimator(RandomMedium{.explorers = 4, .particle = particle}, c.line, sigma, rng);
      for (std::size_t k = 0; k < 3; ++k) values[k].add(estimate.value[k]);
    }
    for (std::size_t k = 0; k < 3; ++k) expectMean(values[k], std::exp(-sigma[k]), kSeed, c.name);
  }
}

TEST(RandomMedium, VariesWithTheDifferenceToItsMainPart) {
  const double tau = simpson(analytic, 0, kLength);
  for (const std::uint32_t explorers : {2u, 10u, 25u}) {
    for (const double rate : {.5, 1.}) {
      const auto mainPart = [&](double z) {
        const double spacing = kLength / (explorers - 1), at = z / spacing;
        const double i = std::min(std::floor(at), explorers - 2.);
        return analytic(i * spacing) + (at - i) * (analytic((i + 1) * spacing) - analytic(i * spacing));
      };
      const double w =
          simpson([&](double z) { return std::pow(analytic(z) - mainPart(z), 2); }, 0, kLength) / rate;
      const Moments m = measure(RandomMedium{.explorers = explorers, .samplingExtinction = rate},
                                centralRay(), 1, 8000, kSeed);
      std::string what = "explorers " + std::to_string(explorers);
      what += ", rate " + std::to_string(rate);
      expectMean(m.value, std::exp(-tau), kSeed, what);
      expectMean(m.lookups, explorers + kLength * rate, kSeed, what + ", look-ups");
      if (w < 2) expectMean(m.square, std::exp(-2 * tau + w), kSeed, what + ", squares");
    }
  }
}

TEST(RandomMedium, IsExactOnWhatItsMainPartHits) {
  for (const char* name : {"constant", "rising", "falling"}) {
    const TrackingCase c = trackingCase(shape(name), 3, 2);
    Rng rng(kSeed);
    for (const std::uint32_t explorers : {2u, 3u, 11u}) {
      for (int i = 0; i < 50; ++i) {
        const auto estimate =
            runEstimator(RandomMedium{.explorers = explorers}, c.line, Channels<3>{3, 1, 0}, rng);
        ASSERT_NEAR(estimate.value[0], std::exp(-3.), 1e-5 * std::exp(-3.)) << c.name;
        ASSERT_NEAR(estimate.value[1], std::exp(-1.), 1e-5 * std::exp(-1.)) << c.name;
        ASSERT_EQ(estimate.value[2], 1);
      }
    }
  }
}

TEST(RandomMedium, WithoutExplorersIsResidualTrackingAtTheRateOfTheBounds) {
  for (const Shape& s : shapes()) {
    const TrackingCase c = trackingCase(s, 1.5, 1.2, 5, .9);
    Rng a(kSeed), b(kSeed);
    for (int i = 0; i < 500; ++i) {
      const double random =
          runEstimator(RandomMedium{.explorers = 0, .rateFloor = 1}, c.line, Channels<1>{c.tau}, a).value[0];
      const double residual = runEstimator(ResidualRatioTracking(), c.line, Channels<1>{c.tau}, b).value[0];
      ASSERT_NEAR(random, residual, 1e-9 * std::abs(residual)) << c.name;
    }
  }
}

TEST(RandomMedium, IsUnbiasedInEachChannel) {
  const Channels<3> sigma{0, 2, .3};
  for (const Shape& s : shapes()) {
    for (const double control : {.8, 1.3}) {
      const TrackingCase c = trackingCase(s, 1, control, 4, .5);
      Rng rng(kSeed);
      RunningStats values[3];
      for (int i = 0; i < 8000; ++i) {
        const auto estimate = runEstimator(RandomMedium{.explorers = 6}, c.line, sigma, rng);
        for (std::size_t k = 0; k < 3; ++k) values[k].add(estimate.value[k]);
      }
      for (std::size_t k = 0; k < 3; ++k) expectMean(values[k], std::exp(-sigma[k]), kSeed, c.name);
    }
  }
}

TEST(RandomMedium, FindsWhatItsExplorersMissed) {
  // A spike of optical depth 1 between the explorers: the rate's floor keeps the second moment below 1.
  const double width = .02;
  const ProvenLine line{{[&](double x) { return x > .45 && x < .45 + width ? 1 / width : 0.; },
                         {{1, {static_cast<float>(1 / width), 0}}}}};
  const Moments m = measure(RandomMedium{.explorers = 5}, line, 1, 40000, kSeed);
  expectMean(m.value, std::exp(-1.), kSeed, "spike");
  // The automatic rate is half the bound: each part of the spike weighs 1 - 2.
  expectMean(m.square, 1., kSeed, "spike, squares");
  // Negative control: explorers alone see nothing.
  EXPECT_GT(std::abs(zTest(m.value, 1., kSeed).z()), kMaxAbsZ);
}

TEST(RandomMedium, LooksForNothingInVacuum) {
  Rng rng(kSeed);
  const ProvenLine vacuum{{[](double) { return 0.; }, {{1, {0, 0}}}}};
  const auto estimate = runEstimator(RandomMedium(), vacuum, Channels<1>{5}, rng);
  EXPECT_EQ(estimate.value[0], 1);
  EXPECT_EQ(estimate.tally.lookups, 0u);
  const FunctionLine wrong{[](double) { return 1.; }, {{1, {0, 0}}}};
  EXPECT_EQ(runEstimator(RandomMedium(), wrong, Channels<1>{5}, rng).tally.violations, 1u);
}

TEST(RandomMedium, CountsExplorersAgainstItsLimit) {
  const TrackingCase c = trackingCase(shape("cosine"), 1, 1000);
  Rng rng(kSeed);
  for (const std::uint64_t most : {1u, 5u, 10u, 30u}) {
    const auto estimate = runEstimator(RandomMedium{.maxLookups = most}, c.line, Channels<1>{1}, rng);
    EXPECT_LE(estimate.tally.lookups, most);
    EXPECT_EQ(estimate.tally.capped, 1u);
  }
}

}  // namespace
}  // namespace pbrtmedia
