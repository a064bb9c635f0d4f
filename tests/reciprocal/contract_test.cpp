// SPDX-License-Identifier: BSD-2-Clause
// What every estimator of 1/F promises by its traits, checked over the list.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "fields/canonical_line.h"
#include "reciprocal/any_reciprocal.h"
#include "support/contract_line.h"
#include "support/keyword_name.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::ContractLine;
using test::kMaxAbsZ;
using test::RunningStats;
using test::zTest;

constexpr std::uint64_t kSeed = 20241122;
using Bias = EstimatorTraits::Bias;
using Control = EstimatorTraits::Control;

template <std::size_t N, class Line>
Estimate<N> run(const AnyReciprocal& estimator, const Line& line, const Channels<N>& sigmaT, Rng& rng) {
  SampleStream stream(rng);
  return std::visit([&](const auto& held) { return held(line, sigmaT, stream); }, estimator);
}

class ReciprocalContract : public testing::TestWithParam<std::string_view> {
 protected:
  AnyReciprocal estimator_ = *findReciprocal(GetParam());
  ReciprocalTraits traits_ = traitsOf(estimator_);
};

TEST_P(ReciprocalContract, SaysWhatItIs) {
  EXPECT_FALSE(traits_.summary.empty());
  EXPECT_FALSE(traits_.source.empty());
  EXPECT_FALSE(traits_.useWhen.empty());
  EXPECT_FALSE(traits_.domain.empty());
  EXPECT_FALSE(traits_.cost.empty());
  EXPECT_FALSE(traits_.varianceNote.empty());
  EXPECT_TRUE(traits_.bias == Bias::Unbiased || !traits_.biasNote.empty());
}

TEST_P(ReciprocalContract, DescribesParametersThatCanBeSet) {
  std::set<std::string> names;
  for (const ParameterDescription& d : parametersOf(estimator_)) {
    EXPECT_TRUE(names.insert(d.name).second) << d.name << " twice";
    EXPECT_FALSE(d.help.empty()) << d.name;
    ParameterValue value = d.value;
    if (d.type == "bool") value = d.value == "true";
    if (d.type == "float" || d.type == "integer") value = std::stod(d.value);
    const AssignResult set = setParameter(estimator_, d.name, value);
    EXPECT_TRUE(set.known && !set.error) << d.name << ": " << set.error.value_or("unknown");
    const AssignResult wrong = setParameter(estimator_, d.name, ParameterValue(std::string("no such word")));
    EXPECT_TRUE(wrong.known && wrong.error) << d.name;
  }
  EXPECT_FALSE(setParameter(estimator_, "nosuchparameter", ParameterValue(1.0)).known);
}

TEST_P(ReciprocalContract, IsInfiniteForNothingAtNoCost) {
  Rng rng(kSeed);
  for (const auto kind : {ContractLine::Kind::Vacuum, ContractLine::Kind::Point}) {
    const ContractLine line(kind);
    for (const double value : run<3>(estimator_, line, {1, 2, 3}, rng).value) {
      EXPECT_EQ(value, double{kInfinity});
    }
    EXPECT_EQ(line.asked(), 0u);
  }
  const auto dark = run<3>(estimator_, ContractLine(), {0, 0, 0}, rng);
  for (const double value : dark.value) EXPECT_EQ(value, double{kInfinity});
}

TEST_P(ReciprocalContract, CountsEveryLookup) {
  for (const double looseness : {1., 3.}) {
    for (const bool oneBound : {false, true}) {
      Rng rng(kSeed);
      const ContractLine line(looseness, oneBound);
      std::uint64_t lookups = 0;
      for (int i = 0; i < 200; ++i) {
        lookups += run<1>(estimator_, line, {2}, rng).tally.lookups;
        lookups += run<3>(estimator_, line, {.5, 1, 2}, rng).tally.lookups;
      }
      EXPECT_EQ(lookups, line.asked()) << "looseness " << looseness << ", one bound " << oneBound;
      EXPECT_GT(lookups, 0u);
    }
  }
}

TEST_P(ReciprocalContract, KeepsToItsLimitAndCountsWhatItCutsShort) {
  if (!setParameter(estimator_, "maxlookups", ParameterValue(4.0)).known) GTEST_SKIP() << "has no limit";
  EXPECT_TRUE(traitsOf(estimator_).boundedCost);
  EXPECT_NE(traitsOf(estimator_).bias, Bias::Unbiased);
  Rng rng(kSeed);
  std::uint64_t capped = 0;
  for (int i = 0; i < 500; ++i) {
    const auto estimate = run<1>(estimator_, ContractLine(8, true), {1}, rng);
    EXPECT_LE(estimate.tally.lookups, 4u);
    capped += estimate.tally.capped;
  }
  EXPECT_GT(capped, 0u);
}

TEST_P(ReciprocalContract, RepeatsItselfFromTheSameNumbers) {
  Rng a(kSeed), b(kSeed);
  for (int i = 0; i < 50; ++i) {
    const ContractLine line;
    EXPECT_EQ(run<1>(estimator_, line, {2}, a).value[0], run<1>(estimator_, line, {2}, b).value[0]);
  }
}

TEST_P(ReciprocalContract, TreatsThreeChannelsAsOneThatIsScaled) {
  Rng one(kSeed), three(kSeed);
  for (int i = 0; i < 200; ++i) {
    const ContractLine line(1.5);
    const double grey = run<1>(estimator_, line, {4}, one).value[0];
    const Channels<3> values = run<3>(estimator_, line, {1, 2, 4}, three).value;
    if (std::isinf(grey)) {
      EXPECT_EQ(values[0], grey);
      continue;
    }
    EXPECT_NEAR(values[0], 4 * grey, 1e-12 * std::abs(4 * grey));
    EXPECT_NEAR(values[1], 2 * grey, 1e-12 * std::abs(2 * grey));
    EXPECT_NEAR(values[2], grey, 1e-12 * std::abs(grey));
  }
}

/// Estimates on a canonical function of depth `depth`; `extinction` is off by `factor`, for negative
/// controls.
RunningStats valuesOn(const AnyReciprocal& estimator, const CanonicalFunction& function,
                      const CanonicalLine::Setup& setup, double depth, int trials, double factor = 1) {
  const CanonicalLine line(function, setup);
  Rng rng(kSeed);
  RunningStats values;
  for (int i = 0; i < trials; ++i) {
    values.add(run<1>(estimator, line, {factor * depth / line.integral()}, rng).value[0]);
  }
  return values;
}

TEST_P(ReciprocalContract, HasTheMeanItClaimsOnItsDomain) {
  if (traits_.bias != Bias::Unbiased) GTEST_SKIP() << "makes no such claim";
  for (const char* name : {"constant", "composite-sine", "gaussian-m23", "step", "fractal-a", "cosine",
                           "gaussian", "piecewise-random"}) {
    const CanonicalFunction function = *findCanonicalFunction(name);
    if (traits_.needsPositiveDensity && !(function.range().min > 0)) continue;
    for (const double control : {1., 2.}) {
      for (const unsigned superVoxels : {1u, 8u}) {
        for (const double depth : {.05, 3.}) {
          // What has no variance under loose controls has no test by it there.
          const CanonicalLine line(function, {.control = control, .superVoxels = superVoxels});
          if (!traits_.finiteVariance && line.integral() < .25 * line.upperIntegral()) continue;
          const RunningStats values =
              valuesOn(estimator_, function, {.control = control, .superVoxels = superVoxels}, depth, 10000);
          EXPECT_LE(std::abs(values.mean() - 1 / depth), kMaxAbsZ * values.standardError() + 1e-9 / depth)
              << name << ", control " << control << ", super-voxels " << superVoxels << ": "
              << zTest(values, 1 / depth, kSeed);
        }
      }
    }
  }
}

/// The test above can fail: an integral 5 % too small is caught.
TEST_P(ReciprocalContract, WouldNotHaveTheMeanOfAnotherIntegral) {
  if (traits_.bias != Bias::Unbiased) GTEST_SKIP() << "makes no such claim";
  const RunningStats values =
      valuesOn(estimator_, *findCanonicalFunction("composite-sine"), {.control = 1.5}, 1, 20000, .95);
  EXPECT_GT(std::abs(zTest(values, 1).z()), kMaxAbsZ) << zTest(values, 1, kSeed);
}

TEST_P(ReciprocalContract, KeepsItsMeanUnderALowControlIfItSaysSo) {
  if (traits_.bias != Bias::Unbiased || traits_.control == Control::Bounding) {
    GTEST_SKIP() << "makes no such claim";
  }
  // 0.8 of the maximum: points find up to 1 / 0.8 of the control.
  const CanonicalFunction function = *findCanonicalFunction("composite-sine");
  const RunningStats values = valuesOn(estimator_, function, {.control = .8}, 2, 40000);
  EXPECT_LT(std::abs(zTest(values, .5).z()), kMaxAbsZ) << zTest(values, .5, kSeed);
}

TEST_P(ReciprocalContract, IsWrongUnderALowControlWhereItNeedsABound) {
  if (traits_.control != Control::Bounding) GTEST_SKIP() << "needs none";
  const CanonicalFunction function = *findCanonicalFunction("step");
  const RunningStats values = valuesOn(estimator_, function, {.control = .6}, 2, 40000);
  EXPECT_GT(std::abs(zTest(values, .5).z()), kMaxAbsZ) << zTest(values, .5, kSeed);
}

TEST_P(ReciprocalContract, IsOffWhereADensityTouchesNothingIfItSaysSo) {
  if (!traits_.needsPositiveDensity) GTEST_SKIP() << "needs no such density";
  const CanonicalFunction function = *findCanonicalFunction("gaussian");
  const CanonicalLine line(function, {});
  Rng rng(kSeed);
  setParameter(estimator_, "n", ParameterValue(1.0));  // one tooth
  setParameter(estimator_, "levels", ParameterValue(0.0));
  double most = 0;
  for (int i = 0; i < 2000; ++i) most = std::max(most, run<1>(estimator_, line, {1}, rng).value[0]);
  EXPECT_GT(most, 1e6);  // the truth is 1
}

TEST_P(ReciprocalContract, StaysFiniteFromThinnestToThickest) {
  const CanonicalFunction function = *findCanonicalFunction("composite-sine");
  for (const double depth : {1e-200, 1e-8, 1., 1e5, 1e200}) {
    for (const double control : {1., 20.}) {
      Rng rng(kSeed);
      const CanonicalLine line(function, {.control = control});
      for (int i = 0; i < 20; ++i) {
        EXPECT_TRUE(std::isfinite(run<1>(estimator_, line, {depth}, rng).value[0]))
            << "depth " << depth << ", control " << control;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ReciprocalContract, testing::ValuesIn(reciprocalNames()), test::keywordName);

}  // namespace
}  // namespace pbrtmedia
