// SPDX-License-Identifier: BSD-2-Clause
// What every estimator of the list promises by its traits, checked over the list.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "support/contract_line.h"
#include "support/keyword_name.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia {
namespace {

using test::ContractLine;
using test::kMaxAbsZ;
using test::RunningStats;

constexpr std::uint64_t kSeed = 20241122;

template <std::size_t N, class Line>
Estimate<N> run(const AnyEstimator& estimator, const Line& line, const Channels<N>& sigmaT, Rng& rng) {
  return visitEstimator([&](const auto& held) { return test::runEstimator(held, line, sigmaT, rng); },
                        estimator);
}

class EstimatorContract : public testing::TestWithParam<std::string_view> {
 protected:
  AnyEstimator estimator_ = *findEstimator(GetParam());
  EstimatorTraits traits_ = traitsOf(estimator_);
};

/// |mean - truth| within kMaxAbsZ standard errors and the rounding of densities to float.
void expectMean(const RunningStats& values, double truth, double depth, const std::string& what) {
  const double rounding = depth * std::abs(truth) * 0x1p-23 + 1e-12;
  EXPECT_LE(std::abs(values.mean() - truth), kMaxAbsZ * values.standardError() + rounding)
      << what << ": " << test::zTest(values, truth, kSeed);
}

TEST_P(EstimatorContract, SaysWhatItIs) {
  EXPECT_FALSE(traits_.summary.empty());
  EXPECT_FALSE(traits_.source.empty());
  EXPECT_FALSE(traits_.useWhen.empty());
  EXPECT_FALSE(traits_.laws.names().empty());
  EXPECT_TRUE(traits_.bias == EstimatorTraits::Bias::Unbiased || !traits_.biasNote.empty());
  for (const char c : GetParam()) EXPECT_TRUE((c >= 'a' && c <= 'z') || c == '-') << GetParam();
}

TEST_P(EstimatorContract, DescribesParametersThatCanBeSet) {
  std::set<std::string> names;
  for (const ParameterDescription& d : parametersOf(estimator_)) {
    EXPECT_TRUE(names.insert(d.name).second) << d.name << " twice";
    EXPECT_FALSE(d.help.empty()) << d.name;
    ParameterValue value;
    if (d.type == "bool") {
      value = d.value == "true";
    } else if (d.type == "string") {
      value = d.value;
    } else {
      ASSERT_TRUE(d.type == "float" || d.type == "integer") << d.type;
      value = std::stod(d.value);
    }
    const AssignResult set = setParameter(estimator_, d.name, value);
    EXPECT_TRUE(set.known && !set.error) << d.name << ": " << set.error.value_or("unknown");
    const AssignResult wrong = setParameter(estimator_, d.name, ParameterValue(std::string("no such word")));
    EXPECT_TRUE(wrong.known && wrong.error) << d.name;
    if (d.type != "bool") {
      const AssignResult bad = setParameter(estimator_, d.name, ParameterValue(true));
      EXPECT_TRUE(bad.known && bad.error) << d.name;
    }
  }
  EXPECT_FALSE(setParameter(estimator_, "nosuchparameter", ParameterValue(1.0)).known);
}

TEST_P(EstimatorContract, ServesTheLawsItNamesAndNoOther) {
  for (const std::string_view name : lawNames()) {
    const AnyLaw law = *findLaw(name);
    AnyEstimator estimator = estimator_;
    EXPECT_EQ(setLaw(estimator, law), traits_.laws.has(law)) << name;
    if (traits_.laws.has(law)) {
      EXPECT_EQ(nameOf(lawOf(estimator)), name);
    }
  }
  EXPECT_TRUE(traits_.laws.has(lawOf(estimator_)));
}

TEST_P(EstimatorContract, IsExactlyOneWithoutExtinctionOrLength) {
  Rng rng(kSeed);
  for (int i = 0; i < 20; ++i) {
    for (const auto kind : {ContractLine::Kind::Vacuum, ContractLine::Kind::Point}) {
      EXPECT_EQ(run<1>(estimator_, ContractLine(kind), {3}, rng).value[0], 1.0);
      for (const double t : run<3>(estimator_, ContractLine(kind), {1, 2, 3}, rng).value) EXPECT_EQ(t, 1.0);
    }
    const ContractLine line;
    const auto clear = run<3>(estimator_, line, {0, 0, 0}, rng);
    for (const double t : clear.value) EXPECT_EQ(t, 1.0);
  }
}

TEST_P(EstimatorContract, CountsEveryLookup) {
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
    }
  }
}

TEST_P(EstimatorContract, RepeatsItselfFromTheSameNumbers) {
  Rng a(kSeed), b(kSeed);
  for (int i = 0; i < 50; ++i) {
    const ContractLine line;
    EXPECT_EQ(run<1>(estimator_, line, {2}, a).value[0], run<1>(estimator_, line, {2}, b).value[0]);
  }
}

TEST_P(EstimatorContract, TreatsThreeEqualChannelsAsOne) {
  Rng one(kSeed), three(kSeed);
  for (int i = 0; i < 200; ++i) {
    const ContractLine line(1.5);
    const double grey = run<1>(estimator_, line, {2}, one).value[0];
    for (const double t : run<3>(estimator_, line, {2, 2, 2}, three).value) {
      EXPECT_NEAR(t, grey, 1e-12 * std::abs(grey));
    }
  }
}

TEST_P(EstimatorContract, HasTheMeanItClaimsInEveryChannelUnderEveryLaw) {
  if (traits_.bias != EstimatorTraits::Bias::Unbiased) GTEST_SKIP() << "makes no such claim";
  const Channels<3> sigma{0, 1, 3};
  for (const std::string_view lawName : traits_.laws.names()) {
    AnyEstimator estimator = estimator_;
    const AnyLaw law = *findLaw(lawName);
    ASSERT_TRUE(setLaw(estimator, law));
    for (const double looseness : {1., 2.}) {
      for (const bool oneBound : {false, true}) {
        Rng rng(kSeed);
        RunningStats values[3], alone;
        for (int i = 0; i < 20000; ++i) {
          const ContractLine line(looseness, oneBound);
          const auto estimate = run<3>(estimator, line, sigma, rng);
          for (std::size_t c = 0; c < 3; ++c) values[c].add(estimate.value[c]);
          alone.add(run<1>(estimator, line, {1}, rng).value[0]);
        }
        std::string what(lawName);
        what += ", looseness " + std::to_string(looseness) + ", one bound " + std::to_string(oneBound);
        for (std::size_t c = 0; c < 3; ++c) {
          const double depth = sigma[c] * ContractLine::integral();
          expectMean(values[c], transmittanceOf(law, depth), depth, what);
        }
        expectMean(alone, transmittanceOf(law, ContractLine::integral()), ContractLine::integral(), what);
      }
    }
  }
}

TEST_P(EstimatorContract, KeepsItsMeanUnderALowControlIfItSaysSo) {
  if (traits_.bias != EstimatorTraits::Bias::Unbiased ||
      traits_.control == EstimatorTraits::Control::Bounding) {
    GTEST_SKIP() << "makes no such claim";
  }
  Rng rng(kSeed);
  RunningStats values;
  std::uint64_t violations = 0;
  const ContractLine line(.7, false, .5);
  const double depth = ContractLine::integral();
  for (int i = 0; i < 50000; ++i) {
    const auto estimate = run<1>(estimator_, line, {1}, rng);
    values.add(estimate.value[0]);
    violations += estimate.tally.violations;
  }
  expectMean(values, transmittanceOf(lawOf(estimator_), depth), depth, "bounds times 0.7");
  if (traits_.control == EstimatorTraits::Control::Any) {
    EXPECT_GT(violations, 0u);
  }
}

TEST_P(EstimatorContract, StaysWithinItsRangeUnderABound) {
  if (traits_.mayLeaveUnitInterval) GTEST_SKIP() << "makes no such claim";
  Rng rng(kSeed);
  for (int i = 0; i < 20000; ++i) {
    const ContractLine line(i % 2 ? 1 : 4, i % 3 == 0);
    for (const double t : run<3>(estimator_, line, {.1, 1, 5}, rng).value) {
      ASSERT_GE(t, 0.0);
      ASSERT_LE(t, 1.0);
    }
  }
}

TEST_P(EstimatorContract, StaysFiniteFromThinnestToThickest) {
  for (const double sigma : {1e-300, 1e-30, 1e-8, 1e-3, 1., 30., 1e3, 1e5}) {
    for (const double looseness : {1e-3, 1., 20.}) {
      Rng rng(kSeed);
      for (int i = 0; i < 2; ++i) {
        const auto estimate = run<1>(estimator_, ContractLine(looseness), {sigma}, rng);
        // A product of thousands of factors beyond 1 leaves the range of double, and says so as infinity.
        const bool mayOverflow =
            looseness < 1 && traits_.control == EstimatorTraits::Control::Any && sigma >= 30;
        EXPECT_TRUE(std::isfinite(estimate.value[0]) || mayOverflow)
            << "sigma " << sigma << ", looseness " << looseness << ": " << estimate.value[0];
        EXPECT_FALSE(std::isnan(estimate.value[0])) << "sigma " << sigma << ", looseness " << looseness;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, EstimatorContract, testing::ValuesIn(estimatorNames()), test::keywordName);

TEST(ContractLine, HasTheIntegralItClaims) {
  const ContractLine line;
  double sum = 0;
  constexpr int kN = 2000000;
  for (int i = 0; i < kN; ++i) sum += double{line.density((i + .5) * 2 / kN)};
  EXPECT_NEAR(sum * 2 / kN, ContractLine::integral(), 1e-7);
  EXPECT_NEAR(ContractLine::integralTo(2), ContractLine::integral(), 1e-12);
  for (const double s : {.2, .31, .7, 1., 1.2, 1.5, 1.9}) {
    EXPECT_NEAR(ContractLine::integralTo(s + 1e-5) - ContractLine::integralTo(s - 1e-5),
                2e-5 * double{line.density(s)}, 1e-8 + (s == 1.5 || s == 1 ? 2e-5 : 0));
  }
  double enter = 0;
  line.walk([&](double a, double b, const SuperVoxel& bound) {
    EXPECT_EQ(a, enter);
    enter = b;
    double mean = 0;
    for (int i = 0; i < 20000; ++i) {
      const double d = double{line.density(a + (b - a) * (i + .5) / 20000)};
      EXPECT_LE(d, double{bound.upper});
      EXPECT_GE(d, double{bound.lower});
      mean += d / 20000;
    }
    EXPECT_NEAR(mean, double{bound.mean}, 1e-6);
    return true;
  });
  EXPECT_EQ(enter, line.length());
}

/// The contract can fail: an extinction 3 % too small is caught by the mean.
TEST(ContractLine, RejectsAnEstimatorWithASmallBias) {
  Rng rng(kSeed);
  RunningStats values;
  for (int i = 0; i < 50000; ++i) {
    const ContractLine line;
    values.add(test::runEstimator(RatioTracking{}, line, Channels<1>{.97}, rng).value[0]);
  }
  const double depth = ContractLine::integral(), truth = std::exp(-depth);
  EXPECT_GT(std::abs(values.mean() - truth), kMaxAbsZ * values.standardError());
}

}  // namespace
}  // namespace pbrtmedia
