// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/biased_ray_marching.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "support/contract_line.h"
#include "support/function_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimators/ray_marching.h"
#include "transmittance/estimators/two_comb_umvu.h"

namespace pbrtmedia {
namespace {

using test::FunctionLine;
using test::kMaxAbsZ;
using test::runEstimator;
using test::RunningStats;

constexpr std::uint64_t kSeed = 20241122;

FunctionLine cosine() {
  return {[](double s) { return 1 + std::cos(20 * s + .8); }, {{1, {2, 0}}}};
}
double cosineIntegral() { return 1 + (std::sin(20.8) - std::sin(.8)) / 20; }

/// What an equidistant comb of M teeth at offset u finds.
double columnOf(const FunctionLine& line, int teeth, double u) {
  double sum = 0;
  for (int j = 0; j < teeth; ++j) sum += line.function((u + j) / teeth);
  return sum / teeth;
}
/// Mean over the comb's offset, which is its only random number.
template <class F>
double meanOverOffset(F&& f) {
  return test::simpson(f, 0, 1, 2000);
}

TEST(BiasedRayMarching, HasTheBiasOfItsComb) {
  const FunctionLine line = cosine();
  for (const int teeth : {2, 4, 5}) {
    for (const double sigma : {.5, 2.}) {
      const double truth = std::exp(-sigma * cosineIntegral());
      const double mean =
          meanOverOffset([&](double u) { return std::exp(-sigma * columnOf(line, teeth, u)); });
      const double variance = meanOverOffset([&](double u) {
        const double x = sigma * (columnOf(line, teeth, u) - cosineIntegral());
        return x * x;
      });
      const BiasedRayMarching estimator{.tupleSize = static_cast<std::uint64_t>(teeth)};
      const auto test = test::runZTest(
          [&](Rng& rng) { return runEstimator(estimator, line, Channels<1>{sigma}, rng).value[0]; }, mean,
          kSeed, 100000);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << teeth << ": " << test;
      // T Var[X] / 2, up to the third and fourth moments.
      EXPECT_NEAR((mean - truth) / (truth * variance / 2), 1, .1 + variance) << teeth << ", " << sigma;
      EXPECT_GT(mean, truth);
    }
  }
}

TEST(BiasedRayMarching, HasMoreBiasWithStratifiedCombs) {
  const FunctionLine line = cosine();
  const double truth = std::exp(-2 * cosineIntegral());
  const auto meanOf = [&](Comb comb) {
    Rng rng(kSeed);
    RunningStats values;
    for (int i = 0; i < 100000; ++i) {
      values.add(
          runEstimator(BiasedRayMarching{.comb = comb, .tupleSize = 12}, line, Channels<1>{2}, rng).value[0]);
    }
    return values;
  };
  const RunningStats equidistant = meanOf(Comb::Equidistant), stratified = meanOf(Comb::Stratified);
  EXPECT_LT(std::abs(equidistant.mean() - truth) * 2, stratified.mean() - truth);
  EXPECT_GT(test::zTest(stratified, truth, kSeed).z(), kMaxAbsZ);
  EXPECT_LT(equidistant.variance(), stratified.variance());
}

TEST(BiasedRayMarching, SpendsTheFormulaOfItsControl) {
  Rng rng(kSeed);
  const FunctionLine line{[](double s) { return s; }, {{1, {1, 0}}}}, lower{line.function, {{1, {1, .25f}}}};
  EXPECT_EQ(runEstimator(BiasedRayMarching(), line, Channels<1>{1}, rng).tally.lookups, 5u);
  EXPECT_EQ(runEstimator(BiasedRayMarching(), line, Channels<1>{10}, rng).tally.lookups, 22u);  // with ends
  EXPECT_EQ(runEstimator(BiasedRayMarching(), lower, Channels<1>{4}, rng).tally.lookups,
            static_cast<std::uint64_t>(pSeriesCmfLookups(3)) + 2);
  const auto capped = runEstimator(BiasedRayMarching{.maxLookups = 6}, line, Channels<1>{10}, rng);
  EXPECT_EQ(capped.tally.lookups, 6u);
  EXPECT_EQ(capped.tally.capped, 1u);
}

TEST(BiasedRayMarching, ServesEveryLawExactlyOnALine) {
  const FunctionLine line{[](double s) { return .5 + s; }, {{1, {1.5f, .5f}}}};
  const Channels<3> sigma{0, .3, 2};
  for (const std::string_view name : lawNames()) {
    Rng rng(kSeed);
    BiasedRayMarching estimator{.endpointMatching = EndpointMatching::On};
    estimator.law = *findLaw(name);
    const auto estimate = runEstimator(estimator, line, sigma, rng);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(estimate.value[c], transmittanceOf(estimator.law, sigma[c]), 1e-6) << name;
    }
  }
}

TEST(RayMarching, IsTheSumOverEqualSteps) {
  const FunctionLine line = cosine();
  Rng rng(kSeed);
  for (const auto& [step, teeth] : {std::pair{.3, 4}, {.25, 4}, {1., 1}, {7., 1}, {.01, 100}}) {
    const RayMarching estimator{.stepSize = step, .offset = StepOffset::Midpoint};
    const auto estimate = runEstimator(estimator, line, Channels<1>{2}, rng);
    EXPECT_NEAR(estimate.value[0], std::exp(-2 * columnOf(line, teeth, .5)), 1e-6) << step;
    EXPECT_EQ(estimate.tally.lookups, static_cast<std::uint64_t>(teeth)) << step;
  }
  EXPECT_EQ(runEstimator(RayMarching{.steps = 17}, line, Channels<1>{2}, rng).tally.lookups, 17u);
}

TEST(RayMarching, WithARandomOffsetHasTheBiasOfItsComb) {
  const FunctionLine line = cosine();
  const double mean = meanOverOffset([&](double u) { return std::exp(-2 * columnOf(line, 3, u)); });
  const auto test = test::runZTest(
      [&](Rng& rng) { return runEstimator(RayMarching{.steps = 3}, line, Channels<1>{2}, rng).value[0]; },
      mean, kSeed, 100000);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  const auto unbiased = test::runZTest(
      [&](Rng& rng) { return runEstimator(RayMarching{.steps = 3}, line, Channels<1>{2}, rng).value[0]; },
      std::exp(-2 * cosineIntegral()), kSeed, 100000);
  EXPECT_GT(std::abs(unbiased.z()), kMaxAbsZ) << unbiased;  // the bias is there, and the test sees it
}

TEST(RayMarching, ConvergesUnderEveryLaw) {
  for (const std::string_view name : lawNames()) {
    RayMarching estimator{.stepSize = 1e-4};
    estimator.law = *findLaw(name);
    Rng rng(kSeed);
    const double t = runEstimator(estimator, test::ContractLine(), Channels<1>{1.5}, rng).value[0];
    EXPECT_NEAR(t, transmittanceOf(estimator.law, 1.5 * test::ContractLine::integral()), 2e-4) << name;
  }
}

TEST(RayMarching, NeedsNoBounds) {
  const FunctionLine line{[](double) { return 1.; }, {{.5, {0, 0}}, {1, {0, 0}}}};
  Rng rng(kSeed);
  EXPECT_NEAR(runEstimator(RayMarching(), line, Channels<1>{1}, rng).value[0], std::exp(-1.), 1e-15);
}

TEST(TwoCombUmvu, IsExactForNormalNumbers) {
  // Simpson over both normal numbers, +-9 standard deviations.
  for (const double deviation : {.1, .5, 1., 2.}) {
    for (const double mean : {-3., -.2}) {
      const double result = test::simpson(
          [&](double a) {
            return test::simpson(
                [&](double b) {
                  return TwoCombUmvu::combine(mean + deviation * a, mean + deviation * b) *
                         std::exp(-(a * a + b * b) / 2) / (2 * 3.14159265358979323846);
                },
                -12, 12, 150);
          },
          -12, 12, 150);
      EXPECT_NEAR(result, std::exp(mean), 1e-9 * std::exp(mean)) << deviation;
      // Negative control: one normal number alone is biased.
      EXPECT_GT(std::exp(deviation * deviation / 2), 1.004);
    }
  }
}

TEST(TwoCombUmvu, HasTheBiasOfTheGeneratingFunctionElsewhere) {
  const FunctionLine line{[](double s) { return 9 * s * s * s; }, {{1, {9, 0}}}};  // skewed, tau = 2.25
  for (const int teeth : {1, 2, 3}) {
    const double truth = std::exp(-2.25);
    double third = 0;
    const auto deviationAt = [&](double u) { return 2.25 - columnOf(line, teeth, u); };
    const std::complex<double> z(.5, .5);
    const double re = meanOverOffset([&](double u) { return std::exp(z * deviationAt(u)).real(); });
    const double im = meanOverOffset([&](double u) { return std::exp(z * deviationAt(u)).imag(); });
    third = meanOverOffset([&](double u) { return std::pow(deviationAt(u), 3); });
    const double mean = truth * (re * re + im * im);
    const TwoCombUmvu estimator{.endpointMatching = EndpointMatching::Off,
                                .tupleSize = static_cast<std::uint64_t>(teeth)};
    const auto test =
        test::runZTest([&](Rng& rng) { return runEstimator(estimator, line, Channels<1>{1}, rng).value[0]; },
                       mean, kSeed, 400000);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << teeth << ": " << test;
    const double fourth = meanOverOffset([&](double u) { return std::pow(deviationAt(u), 4); });
    const double second = meanOverOffset([&](double u) { return std::pow(deviationAt(u), 2); });
    const double leading = -truth * (third / 12 + (fourth - 3 * second * second) / 48);
    EXPECT_NEAR((mean - truth) / leading, 1, .5 * std::sqrt(second)) << teeth;
    if (teeth == 1) {
      const auto biased = test;
      EXPECT_GT(std::abs(biased.mean - truth) / biased.standardError, kMaxAbsZ) << "no bias to be seen";
    }
    // Less than that of one comb with the same teeth.
    const double one = meanOverOffset([&](double u) { return std::exp(-columnOf(line, teeth, u)); });
    EXPECT_LT(std::abs(mean - truth), std::abs(one - truth));
  }
}

TEST(TwoCombUmvu, SpendsTheSameOnEveryLine) {
  Rng rng(kSeed);
  for (const double sigma : {.1, 1., 4., 40.}) {
    const double n = pSeriesCmfLookups(2 * sigma), each = std::floor(n / 2 + .5);
    for (int i = 0; i < 10; ++i) {
      EXPECT_EQ(runEstimator(TwoCombUmvu(), cosine(), Channels<1>{sigma}, rng).tally.lookups,
                static_cast<std::uint64_t>(2 * each + (each >= 8 ? 2 : 0)));
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
