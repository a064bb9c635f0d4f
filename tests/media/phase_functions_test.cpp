// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/diagnostics.h"
#include "base/rng.h"
#include "media/phase/phase_mixture.h"
#include "media/phase/phase_params.h"
#include "media/phase/rayleigh.h"
#include "support/function_line.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using Kind = PhaseLobe::Kind;
constexpr std::uint64_t kSeed = 20241123;

struct Case {
  const char* name;
  std::vector<PhaseLobe> lobes;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"Rayleigh", {{Kind::Rayleigh}}},
      {"isotropic", {{Kind::Isotropic}}},
      {"two Henyey-Greenstein lobes", {{Kind::HenyeyGreenstein, .8f, 3}, {Kind::HenyeyGreenstein, -.4f, 1}}},
      {"three kinds",
       {{Kind::Rayleigh, 0, .2f}, {Kind::Isotropic, 0, .3f}, {Kind::HenyeyGreenstein, .6f, .5f}}},
      {"a lobe without weight", {{Kind::HenyeyGreenstein, .9f, 0}, {Kind::Rayleigh, 0, 2}}}};
  return all;
}

/// Value for the cosine m to the direction of travel.
double valueAt(const PhaseFunction& phase, double m) {
  const Vector3f wi(static_cast<float>(std::sqrt(1 - m * m)), 0, static_cast<float>(-m));
  return double{phase.evaluate({0, 0, 1}, wi)};
}

TEST(PhaseFunctions, RayleighHasItsClosedForm) {
  const Rayleigh phase;
  EXPECT_NEAR(valueAt(phase, 1), 3 / (8 * std::numbers::pi), 1e-7);
  EXPECT_NEAR(valueAt(phase, -1), 3 / (8 * std::numbers::pi), 1e-7);
  EXPECT_NEAR(valueAt(phase, 0), 3 / (16 * std::numbers::pi), 1e-7);
}

TEST(PhaseFunctions, IntegrateToOne) {
  for (const Case& c : cases()) {
    const auto phase = makePhaseFunction(c.lobes);
    const double integral =
        test::simpson([&](double m) { return 2 * std::numbers::pi * valueAt(*phase, m); }, -1, 1, 4000);
    EXPECT_NEAR(integral, 1, 2e-6) << c.name;
  }
}

TEST(PhaseFunctions, AMixtureIsTheWeightedSumOfItsLobes) {
  const auto mixture = makePhaseFunction({{Kind::HenyeyGreenstein, .8f, 3}, {Kind::Rayleigh, 0, 1}});
  const auto a = makePhaseFunction({{Kind::HenyeyGreenstein, .8f, 1}}),
             b = makePhaseFunction({{Kind::Rayleigh}});
  for (const double m : {-1., -.3, 0., .7, 1.}) {
    EXPECT_NEAR(valueAt(*mixture, m), .75 * valueAt(*a, m) + .25 * valueAt(*b, m), 1e-7);
  }
}

TEST(PhaseFunctions, SampleTheirOwnValue) {
  for (const Case& c : cases()) {
    const auto phase = makePhaseFunction(c.lobes);
    const Vector3f wo = normalize(Vector3f(.3f, -1, .2f));
    constexpr int kBins = 40, kSamples = 200000;
    std::vector<double> observed(kBins, 0.0), expected;
    for (int bin = 0; bin < kBins; ++bin) {
      const double a = -1 + 2.0 * bin / kBins;
      expected.push_back(kSamples *
                         test::simpson([&](double m) { return 2 * std::numbers::pi * valueAt(*phase, m); }, a,
                                       std::min(a + 2.0 / kBins, 1.0), 200));
    }
    Rng rng(kSeed);
    for (int n = 0; n < kSamples; ++n) {
      const auto sample = phase->sample(wo, {rng.uniform(), rng.uniform()});
      ASSERT_NEAR(length(sample.wi), 1, 1e-6) << c.name;
      ASSERT_EQ(sample.value, phase->evaluate(wo, sample.wi)) << c.name;
      const double m = -double{dot(wo, sample.wi)};
      ++observed[static_cast<std::size_t>(std::clamp((m + 1) / 2 * kBins, 0.0, kBins - 1.0))];
    }
    const auto result = test::chiSquareTest(observed, expected);
    EXPECT_GT(result.pValue(), test::kMinPValue) << c.name << ": " << result;
  }
}

TEST(PhaseFunctions, AnotherPhaseFunctionIsNoticedByTheTest) {
  const auto rayleigh = makePhaseFunction({{Kind::Rayleigh}}),
             isotropic = makePhaseFunction({{Kind::Isotropic}});
  std::vector<double> observed(20, 0.0), expected(20, 100000 / 20.0);
  Rng rng(kSeed);
  for (int n = 0; n < 100000; ++n) {
    const double m = double{rayleigh->sample({0, 0, 1}, {rng.uniform(), rng.uniform()}).wi.z};
    ++observed[static_cast<std::size_t>(std::clamp((m + 1) * 10, 0.0, 19.0))];
  }
  EXPECT_LT(test::chiSquareTest(observed, expected).pValue(), test::kMinPValue);
}

TEST(PhaseFunctions, StayFiniteAtTheEndsOfTheUnitSquare) {
  for (const Case& c : cases()) {
    const auto phase = makePhaseFunction(c.lobes);
    for (const float u : {0.0f, .25f, .5f, .75f, kOneMinusEpsilon}) {
      const auto sample = phase->sample({0, 1, 0}, {u, u});
      EXPECT_TRUE(isFinite(sample.wi)) << c.name << ' ' << u;
      EXPECT_TRUE(std::isfinite(sample.value) && sample.value > 0) << c.name << ' ' << u;
    }
  }
}

TEST(PhaseFunctions, RefuseWhatIsNoMixture) {
  EXPECT_THROW(makePhaseFunction({}), SceneError);
  EXPECT_THROW(makePhaseFunction({{Kind::Rayleigh, 0, 0}, {Kind::Isotropic, 0, 0}}), SceneError);
  EXPECT_THROW(makePhaseFunction({{Kind::Rayleigh, 0, -1}, {Kind::Isotropic, 0, 2}}), SceneError);
  EXPECT_THROW(makePhaseFunction({{Kind::HenyeyGreenstein, 1, 1}, {Kind::Isotropic, 0, 2}}), SceneError);
}

}  // namespace
}  // namespace pbrtmedia
