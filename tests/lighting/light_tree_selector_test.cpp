// SPDX-License-Identifier: BSD-2-Clause
#include "lighting/light_tree_selector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lighting/light_strategy.h"
#include "media/phase/henyey_greenstein.h"
#include "support/many_lights.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::kBoxOfLights;
using test::kMaxAbsZ;
using test::kMinPValue;
using test::ManyLights;

const HenyeyGreenstein kForward(0.9f);

/// Points in space, on surfaces and in a medium.
std::vector<LightReceiver> someReceivers() {
  std::vector<LightReceiver> all;
  for (const Point3f p : {Point3f{0, 1, 2}, Point3f{-9, 9, 4}, Point3f{300, 0, 0}}) {
    all.emplace_back(p);
    all.emplace_back(p).n = normalize(Vector3f{1, -2, 0.5f});
    LightReceiver& medium = all.emplace_back(p);
    medium.phase = &kForward;
    medium.wo = normalize(Vector3f{-1, 1, 1});
  }
  return all;
}

double sumOfProbabilities(const LightSelector& selector, const LightReceiver& at, std::size_t lights) {
  double sum = 0;
  for (std::size_t i = 0; i < lights; ++i) sum += double{selector.probability(at, i)};
  return sum;
}

TEST(LightTreeSelector, ProbabilitiesArePositiveAndSumToOne) {
  for (const auto& [places, far, hasSky] : {std::tuple{2, 0, false},
                                            {0, 2, true},
                                            {5, 1, true},
                                            {16, 0, false},
                                            {17, 0, true},
                                            {0, 20, false},
                                            {500, 30, true}}) {
    const ManyLights lights(static_cast<std::size_t>(places), static_cast<std::size_t>(far), hasSky);
    const LightTreeSelector selector(lights.all(), kBoxOfLights);
    for (const LightReceiver& at : someReceivers()) {
      EXPECT_NEAR(sumOfProbabilities(selector, at, lights.size()), 1, 1e-5);
      for (std::size_t i = 0; i < lights.size(); ++i) EXPECT_GT(selector.probability(at, i), 0);
    }
  }
}

TEST(LightTreeSelector, ChoosesWithTheProbabilitiesItStates) {
  const ManyLights lights(100, 12, true);
  const LightTreeSelector selector(lights.all(), kBoxOfLights);
  constexpr int kCount = 100000;
  const std::vector<LightReceiver> receivers = someReceivers();
  std::vector<std::vector<double>> observed;
  const auto expectedAt = [&](const LightReceiver& at) {
    std::vector<double> expected;
    for (std::size_t i = 0; i < lights.size(); ++i)
      expected.push_back(double{kCount} * double{selector.probability(at, i)});
    return expected;
  };
  for (const LightReceiver& at : receivers) {
    Rng rng(3);
    std::vector<double>& counts = observed.emplace_back(lights.size());
    for (int i = 0; i < kCount; ++i) {
      const LightSelector::Choice c = selector.choose(at, rng.uniform());
      EXPECT_FLOAT_EQ(c.probability, selector.probability(at, c.light));
      ++counts[c.light];
    }
    const test::ChiSquareTest t = test::chiSquareTest(counts, expectedAt(at));
    EXPECT_GT(t.pValue(), test::sidak(kMinPValue, receivers.size())) << t;
  }
  // The test sees that normals and phase functions have their part.
  for (const std::size_t other : {1u, 2u}) {
    const test::ChiSquareTest t = test::chiSquareTest(observed[0], expectedAt(receivers[other]));
    EXPECT_LT(t.pValue(), kMinPValue) << t;
  }
}

/// What one light sends to a surface at `at`, by one sample.
double irradiance(const Light& light, const LightReceiver& at, Rng& rng) {
  const LightSample s = light.sample(at.p, {rng.uniform(), rng.uniform()});
  return s.pdf > 0 ? double{s.radiance.r} * std::max(0.0f, dot(at.n, s.wi)) / double{s.pdf} : 0;
}

TEST(LightTreeSelector, OneLightStandsForAllOfThem) {
  const ManyLights lights(200, 9, true);
  LightReceiver at(Point3f{1, 2, -3});
  at.n = normalize(Vector3f{0.2f, -1, 0.3f});
  test::RunningStats sums;
  Rng rng(9);
  for (int i = 0; i < 3000; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < lights.size(); ++k) sum += irradiance(lights[k], at, rng);
    sums.add(sum);
  }
  const auto ratio = [&](const LightSelector& selector, const LightReceiver& seen) {
    test::RunningStats values;
    Rng random(21);
    for (int i = 0; i < 100000; ++i) {
      const LightSelector::Choice c = selector.choose(at, random.uniform());
      values.add(irradiance(lights[c.light], at, random) / double{selector.probability(seen, c.light)});
    }
    return std::pair{test::ZTest{values.mean(), sums.mean(), values.standardError(), sums.standardError(), 21,
                                 values.count()},
                     values.variance()};
  };
  const LightTreeSelector tree(lights.all(), kBoxOfLights);
  const auto [right, variance] = ratio(tree, at);
  EXPECT_LT(std::abs(right.z()), kMaxAbsZ) << right;
  EXPECT_TRUE(right.sees(0.05)) << right;
  LightReceiver turned = at;
  turned.n = -at.n;
  EXPECT_GT(std::abs(ratio(tree, turned).first.z()), kMaxAbsZ);
  // That is what it is for.
  const auto power = makeLightSelector(LightStrategy::Power, lights.all(), kBoxOfLights);
  EXPECT_LT(variance, 0.3 * ratio(*power, at).second);
}

TEST(LightTreeSelector, LeavesUniformLightsToDirectionsUnlessThereAreNoOthers) {
  const ManyLights lights(3, 1, true);
  const LightTreeSelector selector(lights.all(), kBoxOfLights);
  LightReceiver at(Point3f{});
  EXPECT_GT(selector.probability(at, 4), 0);
  at.findsUniformLights = true;
  EXPECT_EQ(selector.probability(at, 4), 0);
  EXPECT_NEAR(sumOfProbabilities(selector, at, lights.size()), 1, 1e-6);

  const ManyLights skies(0, 0, true);
  const std::vector<const Illuminant*> two{&skies[0], &skies[0]};
  const LightTreeSelector onlySkies(two, kBoxOfLights);
  EXPECT_EQ(onlySkies.probability(at, 0), 0.5f);
}

TEST(LightTreeSelector, NoWeightIsMuchAboveThatOfPower) {
  const ManyLights lights(300, 3, true);
  const LightTreeSelector selector(lights.all(), kBoxOfLights);
  const auto power = makeLightSelector(LightStrategy::Power, lights.all(), kBoxOfLights);
  for (const LightReceiver& at : someReceivers()) {
    for (std::size_t i = 300; i < lights.size(); ++i)
      EXPECT_GE(selector.probability(at, i), 0.999f * 0.1f * power->probability(at, i));
  }
}

TEST(LightTreeSelector, DecidesWhereNothingIsFinite) {
  const ManyLights lights(30, 1, true);
  for (const Bounds3f& bounds : {Bounds3f{}, Bounds3f{{1, 1, 1}, {1, 1, 1}}}) {
    const LightTreeSelector selector(lights.all(), bounds);
    for (const float x : {0.0f, 1e30f, kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
      const LightReceiver at(Point3f{x, 0, x});
      EXPECT_NEAR(sumOfProbabilities(selector, at, lights.size()), 1, 1e-5);
      const LightSelector::Choice c = selector.choose(at, 0.7f);
      EXPECT_LT(c.light, lights.size());
      EXPECT_GT(c.probability, 0);
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
