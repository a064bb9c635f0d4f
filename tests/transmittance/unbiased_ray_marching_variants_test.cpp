// SPDX-License-Identifier: BSD-2-Clause
// Every variant of unbiased ray marching keeps the mean, and the default gains what its parts promise.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fields/canonical_function.h"
#include "fields/canonical_line.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimators/unbiased_ray_marching.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::runEstimator;
using test::RunningStats;

constexpr std::uint64_t kSeed = 20241122;

struct Variant {
  const char* what;
  UnbiasedRayMarching estimator;
};
std::vector<Variant> variants() {
  return {
      {"no symmetrisation", {.symmetrisation = false}},
      {"roulette bk", {.roulette = Roulette::BhanotKennedy}},
      {"roulette cmf", {.roulette = Roulette::Cmf}},
      {"roulette cumulative", {.roulette = Roulette::Cumulative}},
      {"zero order probability 0.5", {.zeroOrderProbability = .5}},
      {"expansion 0.5", {.expansion = .5}},
      {"expansion 4", {.expansion = 4}},
      {"expansion by the control", {.expansion = 0}},
      {"stratified", {.comb = Comb::Stratified}},
      {"independent", {.comb = Comb::Independent}},
      {"golden ratio", {.comb = Comb::GoldenRatio}},
      {"stratified, matched", {.comb = Comb::Stratified, .endpointMatching = EndpointMatching::On}},
      {"independent, matched", {.comb = Comb::Independent, .endpointMatching = EndpointMatching::On}},
      {"golden ratio, matched", {.comb = Comb::GoldenRatio, .endpointMatching = EndpointMatching::On}},
      {"ends off", {.endpointMatching = EndpointMatching::Off}},
      {"ends on", {.endpointMatching = EndpointMatching::On}},
      {"majorant pivot, roulette cmf", {.pivot = Pivot::Majorant, .roulette = Roulette::Cmf}},
      {"majorant pivot, plain, roulette cumulative",
       {.pivot = Pivot::Majorant, .symmetrisation = false, .roulette = Roulette::Cumulative}},
      {"fixed pivot, roulette bk, expansion 3",
       {.pivot = Pivot::Fixed, .roulette = Roulette::BhanotKennedy, .expansion = 3}},
      {"fixed pivot, plain, expansion 3",
       {.pivot = Pivot::Fixed, .symmetrisation = false, .roulette = Roulette::BhanotKennedy, .expansion = 3}},
      {"tuple size 1", {.roulette = Roulette::BhanotKennedy, .expansion = 3, .tupleSize = 1}},
      {"tuple size 6", {.tupleSize = 6}},
      {"limit 3", {.maxLookups = 3}},
      {"warp off", {.warp = Warp::Off}},
      {"warp on", {.warp = Warp::On}}};
}

RunningStats run(const UnbiasedRayMarching& estimator, const CanonicalLine& line, double sigma, int n,
                 double* lookups = nullptr) {
  Rng rng(kSeed);
  RunningStats values, spent;
  for (int i = 0; i < n; ++i) {
    const auto estimate = runEstimator(estimator, line, Channels<1>{sigma}, rng);
    values.add(estimate.value[0]);
    spent.add(static_cast<double>(estimate.tally.lookups));
  }
  if (lookups != nullptr) *lookups = spent.mean();
  return values;
}

/// Within kMaxAbsZ standard errors and what sums of doubles lose.
void expectMean(const RunningStats& values, double tau, const std::string& what) {
  const double truth = std::exp(-tau), rounding = (1 + tau) * truth * 0x1p-42;
  EXPECT_LE(std::abs(values.mean() - truth), kMaxAbsZ * values.standardError() + rounding)
      << what << ": " << test::zTest(values, truth, kSeed);
}

TEST(UnbiasedRayMarchingVariants, DefaultKeepsItsMeanOnEveryFunctionUnderEveryControl) {
  for (const char* name : {"constant", "cosine", "gaussian", "hole", "linear-up", "linear-down", "step"}) {
    const CanonicalFunction function = *findCanonicalFunction(name);
    for (const double sigma : {.05, .5, 2.3, 6.}) {
      for (const double control : {1., 1.5, 5., .6, .9}) {
        const CanonicalLine line(function, {.control = control, .superVoxels = control == 1.5 ? 8u : 1u});
        expectMean(
            run(UnbiasedRayMarching(), line, sigma, 20000), sigma * line.integral(),
            std::string(name) + ", sigma " + std::to_string(sigma) + ", control " + std::to_string(control));
      }
    }
  }
}

TEST(UnbiasedRayMarchingVariants, EachKeepsItsMean) {
  for (const Variant& variant : variants()) {
    for (const char* name : {"cosine", "linear-up", "step"}) {
      const CanonicalFunction function = *findCanonicalFunction(name);
      for (const double sigma : {.5, 2.3}) {
        for (const double control : {1.2, .7}) {
          const CanonicalLine line(function, {.control = control, .superVoxels = control < 1 ? 1u : 5u});
          expectMean(run(variant.estimator, line, sigma, 12000), sigma * line.integral(),
                     std::string(variant.what) + ", " + name + ", sigma " + std::to_string(sigma) +
                         ", control " + std::to_string(control));
        }
      }
    }
  }
}

/// Negative control: the truncated series is biased, and this sample size shows it.
TEST(UnbiasedRayMarchingVariants, WithoutRouletteTheMeanIsMissed) {
  const CanonicalFunction function = *findCanonicalFunction("cosine");
  const CanonicalLine line(function, {});
  const UnbiasedRayMarching truncated{.roulette = Roulette::None, .expansion = 1, .tupleSize = 1};
  const RunningStats values = run(truncated, line, 2.3, 30000);
  EXPECT_GT(std::abs(test::zTest(values, std::exp(-2.3 * line.integral()), kSeed).z()), kMaxAbsZ);
}

/// The ablation: each part of the method, taken away, costs efficiency (variance x cost, geometric mean over
/// functions that no comb integrates exactly).
TEST(UnbiasedRayMarchingVariants, EveryPartOfTheMethodPays) {
  const struct {
    const char* what;
    UnbiasedRayMarching estimator;
    double atLeast;
  } rows[] = {{"no symmetrisation", {.symmetrisation = false}, 5},
              {"roulette bk", {.roulette = Roulette::BhanotKennedy}, 4},
              {"independent comb", {.comb = Comb::Independent}, 8},
              {"golden-ratio comb", {.comb = Comb::GoldenRatio}, 2.5},
              {"stratified comb", {.comb = Comb::Stratified}, 2}};
  const auto inefficiency = [](const UnbiasedRayMarching& estimator) {
    double sum = 0;
    int cells = 0;
    for (const char* name : {"cosine", "step", "fractal-a"}) {
      const CanonicalFunction function = *findCanonicalFunction(name);
      for (const double sigma : {.1, 1., 4.}) {
        for (const double control : {1., 2., 10.}) {
          const CanonicalLine line(function, {.control = control});
          double lookups = 0;
          const double variance = run(estimator, line, sigma, 4000, &lookups).variance();
          // Below this variances that mean nothing would count.
          const double floor = std::exp(-2 * sigma * line.integral()) * 1e-13;
          sum += std::log(std::max(variance, floor) * lookups);
          ++cells;
        }
      }
    }
    return std::exp(sum / cells);
  };
  const double base = inefficiency(UnbiasedRayMarching());
  for (const auto& row : rows) {
    const double factor = inefficiency(row.estimator) / base;
    RecordProperty(row.what, std::to_string(factor));
    EXPECT_GT(factor, row.atLeast) << row.what;
  }
}

}  // namespace
}  // namespace pbrtmedia
