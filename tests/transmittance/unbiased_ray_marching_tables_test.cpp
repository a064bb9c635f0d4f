// SPDX-License-Identifier: BSD-2-Clause
// Variance and cost of the ray marchers against independent computations from their definitions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fields/canonical_function.h"
#include "fields/canonical_line.h"
#include "support/printed.h"
#include "support/run_estimator.h"
#include "support/statistics.h"
#include "transmittance/estimators/biased_ray_marching.h"
#include "transmittance/estimators/unbiased_ray_marching.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::Printed;
using test::runEstimator;
using test::RunningStats;

constexpr std::uint64_t kSeed = 20241122;

/// A density on [0, 1] as a table of 2^18 straight pieces (relative error below 1e-6), for many look-ups.
class TabulatedLine {
 public:
  static constexpr bool hasProvenBounds() { return true; }

  TabulatedLine(const CanonicalFunction& function, double upper)
      : values_(kCells + 2), upper_(static_cast<float>(upper)) {
    for (std::size_t i = 0; i <= kCells; ++i) values_[i] = function(static_cast<double>(i) / kCells);
    values_[kCells + 1] = values_[kCells];
  }
  double length() const { return 1; }
  float density(double s) const {
    const double at = s * kCells, cell = std::floor(at);
    const double* v = values_.data() + static_cast<std::size_t>(cell);
    return static_cast<float>(v[0] + (at - cell) * (v[1] - v[0]));
  }
  void densities(std::span<const double> s, std::span<float> out) const { densitiesOneByOne(*this, s, out); }
  template <class Visit>
  void walk(Visit&& visit) const {
    visit(0.0, 1.0, SuperVoxel{upper_, 0});
  }
  /// Exact integral of the table: the trapezoidal rule.
  double integral() const {
    double sum = (values_[0] + values_[kCells]) / 2;
    for (std::size_t i = 1; i < kCells; ++i) sum += values_[i];
    return sum / kCells;
  }

 private:
  static constexpr std::size_t kCells = 1u << 18;
  std::vector<double> values_;
  float upper_;
};

/// What n estimates were like, with the error of their variance.
struct Estimates {
  std::vector<double> values;
  RunningStats stats, lookups, squaredErrors;

  template <class Estimator, class Line>
  Estimates(const Estimator& estimator, const Line& line, double sigma, double truth, std::size_t n) {
    Rng rng(kSeed);
    values.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto estimate = runEstimator(estimator, line, Channels<1>{sigma}, rng);
      const double error = estimate.value[0] - truth;
      values.push_back(estimate.value[0]);
      stats.add(estimate.value[0]);
      lookups.add(static_cast<double>(estimate.tally.lookups));
      squaredErrors.add(error * error);
    }
  }
};

/// Computed and printed agree within four standard errors of both runs, the printed digits, and the rounding
/// of densities to float (`rounding`, a relative error of the transmittance).
void expectPrinted(const RunningStats& squares, const char* text, double printedRuns, double truth,
                   double rounding, const std::string& what) {
  const Printed printed(text);
  const double n = static_cast<double>(squares.count());
  const double error = squares.standardError() * std::hypot(1.0, std::sqrt(n / printedRuns));
  const double floor = truth * truth * rounding * rounding;
  EXPECT_LE(std::abs(squares.mean() - printed.value), 4 * error + printed.halfUnit + floor)
      << what << ": " << squares.mean() << ", printed " << text << ", standard error " << error;
}

double controlFor(const CanonicalFunction& function, double ratio) {
  return 1 / (ratio * function.range().max);
}

TEST(UnbiasedRayMarchingTables, CanonicalFunctionsUnderTightAndLooseControls) {
  const struct {
    const char* function;
    double transmittance, ratio;
    const char *variance, *cost;
    std::uint64_t teeth;
  } rows[] = {{"constant", .9, .95, "0", "2.64", 2},      {"constant", .5, .95, "0", "3.96", 3},
              {"constant", .5, .475, "0", "6.60", 5},     {"constant", .1, .475, "0", "15.2", 10},
              {"cosine", .9, .45, "3.5e-4", "2.64", 2},   {"cosine", .5, .45, "9.3e-4", "6.60", 5},
              {"cosine", .5, .225, "4.5e-6", "12.57", 8}, {"cosine", .1, .45, "4.9e-7", "15.19", 10},
              {"gaussian", .9, .12, "3.5e-3", "5.27", 4}, {"gaussian", .5, .12, "1.4e-6", "16.52", 11},
              {"gaussian", .1, .12, "2e-22", "33.7", 24}, {"hole", .5, .85, "9.7e-4", "5.27", 4},
              {"hole", .1, .85, "1.6e-5", "9.23", 7},     {"linear-up", .5, .45, "1.5e-3", "6.60", 5},
              {"linear-up", .1, .45, "0", "15.2", 10}};
  const double orders = OrderRoulette::aggressive(2, .9).expectedOrder();
  for (const auto& row : rows) {
    std::string what(row.function);
    what += ", T " + std::to_string(row.transmittance) + ", ratio " + std::to_string(row.ratio);
    const CanonicalFunction function = *findCanonicalFunction(row.function);
    const double sigma = -std::log(row.transmittance), truth = std::exp(-sigma * function.integral());
    const CanonicalLine line(function, {.control = controlFor(function, row.ratio), .hasMeans = false});
    EXPECT_EQ(tupleSizeFor(sigma / row.ratio, orders, 0), row.teeth) << what;
    const double cost = static_cast<double>(row.teeth) * (1 + orders) + (row.teeth >= 8 ? 2 : 0);
    EXPECT_NEAR(cost, Printed(row.cost).value, 3 * Printed(row.cost).halfUnit) << what;
    const Estimates run(UnbiasedRayMarching(), line, sigma, truth, 150000);
    const double rounding = sigma * 0x1p-23;
    expectPrinted(run.squaredErrors, row.variance, 5e5, truth, rounding, what);
    EXPECT_LE(std::abs(run.stats.mean() - truth), kMaxAbsZ * run.stats.standardError() + truth * rounding)
        << what << ": " << test::zTest(run.stats, truth, kSeed);
    const auto spent = test::zTest(run.lookups, cost, kSeed);
    EXPECT_LT(std::abs(spent.z()), kMaxAbsZ) << what << ": " << spent;
  }
}

TEST(UnbiasedRayMarchingTables, FractalDensitiesUnderRaisedControls) {
  const struct {
    const char* function;
    double transmittance, factor;
    std::uint64_t teeth;
    const char *plain, *matched, *biased, *biasedMatched;
    double biasedCost;
  } rows[] = {{"fractal-a", .22, 1, 8, "1.65e-4", "1.70e-4", "1.3e-5", "1.5e-5", 10},
              {"fractal-a", .22, 2, 11, "3.28e-3", "3.14e-3", "2.1e-5", "1.1e-5", 15},
              {"fractal-a", .22, 4, 18, "7.6e-6", "5.0e-6", "8.7e-6", "9.9e-7", 24},
              {"fractal-a", .22, 16, 52, "1.6e-6", "1.3e-7", "6.2e-7", "4.5e-8", 68},
              {"fractal-a", .22, 64, 171, "7.0e-7", "3.8e-7", "5.0e-8", "2.2e-9", 226},
              {"fractal-b", .22, 1, 7, "4.5e-4", "4.8e-6", "2.7e-4", "7.7e-7", 9},
              {"fractal-b", .22, 4, 16, "7.8e-5", "6.0e-7", "5.4e-5", "4.0e-7", 21},
              {"fractal-b", .22, 16, 45, "7.3e-6", "2.3e-7", "6.1e-6", "8.3e-8", 59},
              {"fractal-b", .22, 64, 148, "8.3e-7", "4.8e-10", "5.5e-7", "5.0e-10", 195},
              {"fractal-a", .85, 1, 2, "1.26e-3", "9.1e-4", "8.9e-4", "7.9e-4", 3},
              {"fractal-a", .85, 8, 7, "1.7e-5", "2.7e-5", "4.7e-6", "4.3e-6", 9},
              {"fractal-a", .85, 32, 17, "1.1e-6", "7.3e-7", "2.2e-4", "1.9e-4", 22}};
  constexpr double kRuns = 4e5, kLookups = 2e6;
  for (const auto& row : rows) {
    const CanonicalFunction function = *findCanonicalFunction(row.function);
    const TabulatedLine line(function, row.factor * function.range().max);
    const double sigma = -std::log(row.transmittance), truth = std::exp(-sigma * line.integral());
    const double control = sigma * row.factor * function.range().max;
    EXPECT_EQ(tupleSizeFor(control, OrderRoulette::aggressive(2, .9).expectedOrder(), 0), row.teeth);
    EXPECT_EQ(pSeriesCmfLookups(control), row.biasedCost);
    const auto n = static_cast<std::size_t>(std::min(kRuns, kLookups / row.biasedCost));
    std::string what(row.function);
    what += ", T " + std::to_string(row.transmittance) + ", factor " + std::to_string(row.factor);
    const double rounding = sigma * 1e-6;
    for (const bool isMatched : {false, true}) {
      const auto matching = isMatched ? EndpointMatching::On : EndpointMatching::Off;
      const Estimates unbiased(UnbiasedRayMarching{.endpointMatching = matching}, line, sigma, truth, n);
      expectPrinted(unbiased.squaredErrors, isMatched ? row.matched : row.plain, kRuns, truth, rounding,
                    what + (isMatched ? ", matched" : ""));
      EXPECT_LE(std::abs(unbiased.stats.mean() - truth),
                kMaxAbsZ * unbiased.stats.standardError() + truth * rounding)
          << what << ": " << test::zTest(unbiased.stats, truth, kSeed);
      const Estimates biased(BiasedRayMarching{.endpointMatching = matching}, line, sigma, truth, n);
      expectPrinted(biased.squaredErrors, isMatched ? row.biasedMatched : row.biased, kRuns, truth, rounding,
                    what + (isMatched ? ", biased, matched" : ", biased"));
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
