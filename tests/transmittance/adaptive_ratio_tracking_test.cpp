// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimators/adaptive_ratio_tracking.h"

#include <gtest/gtest.h>

#include "tracking_cases.h"
#include "transmittance/estimators/ratio_tracking.h"

namespace pbrtmedia {
namespace {

using namespace test;

constexpr std::uint64_t kSeed = 20261104;

/// Remembers where it was looked at.
struct RecordingLine : ProvenLine {
  explicit RecordingLine(const ProvenLine& line) : ProvenLine(line) {}
  float density(double s) const {
    points.push_back(s);
    return ProvenLine::density(s);
  }
  mutable std::vector<double> points;
};

/// What the weights telescope to, channel `c`, from the points looked at; the rate is driven by the channel
/// of least extinction, or by the largest |majorant - mu|.
template <std::size_t N>
double closedForm(const RecordingLine& line, const Channels<N>& sigma, std::size_t c) {
  double product = 1, exponent = 0, enter = 0;
  std::size_t next = 0;
  for (const auto& interval : line.intervals) {
    const double majorant = maxOf(sigma) * double{interval.bound.upper};
    double rate = majorant, at = enter;
    while (next < line.points.size() && line.points[next] < interval.sExit) {
      const double x = line.points[next++], density = double{line.ProvenLine::density(x)};
      exponent += (rate - majorant) * (x - at);
      product *= (majorant - sigma[c] * density) / rate;
      rate = 0;
      for (const double s : sigma) {
        if (s > 0) rate = std::max(rate, std::abs(majorant - s * density));
      }
      at = x;
    }
    exponent += (rate - majorant) * (interval.sExit - at);
    enter = interval.sExit;
  }
  return product * std::exp(exponent);
}

TEST(AdaptiveRatioTracking, EqualsItsClosedFormOnEveryPath) {
  constexpr double kRounding = 1e-12;  // factors are differences from 1
  for (const Shape& s : shapes()) {
    for (const double control : {.7, 1., 1.5, 5.}) {
      for (const int cells : {1, 6}) {
        const TrackingCase c = trackingCase(s, 1.5, control, cells);
        Rng rng(kSeed);
        for (int i = 0; i < 300; ++i) {
          const RecordingLine line(c.line);
          const double value = runEstimator(AdaptiveRatioTracking(), line, Channels<1>{c.tau}, rng).value[0];
          const double exact = closedForm(line, Channels<1>{c.tau}, 0);
          ASSERT_NEAR(value, exact, kRounding * std::max(1., std::abs(exact))) << c.name;
          const RecordingLine again(c.line);
          const Channels<3> sigma{c.tau, .1, .6};
          const auto chromatic = runEstimator(AdaptiveRatioTracking(), again, sigma, rng);
          for (std::size_t k = 0; k < 3; ++k) {
            const double truth = closedForm(again, sigma, k);
            ASSERT_NEAR(chromatic.value[k], truth, kRounding * std::max(1., std::abs(truth)))
                << c.name << ", channel " << k;
          }
        }
      }
    }
  }
}

TEST(AdaptiveRatioTracking, HasTheProductFormOfOneBound) {
  // (1 - mu(x_k) / majorant) exp(-sum mu(x_i) (x_{i+1} - x_i)), with the extinction and not the rate.
  const TrackingCase c = trackingCase(shape("hole"), 2, 2);
  Rng rng(kSeed);
  int withCollision = 0;
  for (int i = 0; i < 1000; ++i) {
    const RecordingLine line(c.line);
    const double value = runEstimator(AdaptiveRatioTracking(), line, Channels<1>{c.tau}, rng).value[0];
    const std::vector<double>& x = line.points;
    if (x.empty()) {
      ASSERT_EQ(value, 1);
      continue;
    }
    ++withCollision;
    double exponent = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double next = k + 1 < x.size() ? x[k + 1] : 1;
      exponent -= c.tau * double{c.line.density(x[k])} * (next - x[k]);
    }
    const double last = 1 - double{c.line.density(x.back())} / double{c.line.intervals[0].bound.upper};
    ASSERT_NEAR(value, last * std::exp(exponent), 1e-12);
  }
  EXPECT_GT(withCollision, 500);
}

TEST(AdaptiveRatioTracking, StaysInTheUnitIntervalAndVariesLessThanABernoulliTrial) {
  for (const Shape& s : shapes()) {
    for (const double tau : {.1, 3.}) {
      for (const int cells : {1, 6}) {
        const TrackingCase c = trackingCase(s, tau, 1.3, cells);
        Rng rng(kSeed);
        RunningStats values;
        for (int i = 0; i < 4000; ++i) {
          const double value = runEstimator(AdaptiveRatioTracking(), c.line, Channels<1>{tau}, rng).value[0];
          ASSERT_GE(value, 0);
          ASSERT_LE(value, 1);
          values.add(value);
        }
        const double truth = std::exp(-tau);
        EXPECT_LT(values.variance(), 1.2 * truth * (1 - truth)) << c.name;
      }
    }
  }
}

TEST(AdaptiveRatioTracking, IsUnbiasedInEachChannelWithinItsRange) {
  const Channels<3> sigma{0, 2, .3};
  for (const Shape& s : shapes()) {
    const TrackingCase c = trackingCase(s, 1, 1.5, 4);
    Rng rng(kSeed);
    RunningStats values[3];
    for (int i = 0; i < 15000; ++i) {
      const auto estimate = runEstimator(AdaptiveRatioTracking(), c.line, sigma, rng);
      ASSERT_EQ(estimate.value[0], 1);  // exactly: it has no extinction
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_GE(estimate.value[k], 0);
        ASSERT_LE(estimate.value[k], 1);
        values[k].add(estimate.value[k]);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) expectMean(values[k], std::exp(-sigma[k]), kSeed, c.name);
  }
}

/// Algorithm 2 as the published renderer has it: without the majorant in the weights.
double withoutMajorant(const TrackingCase& c, Rng& rng) {
  const double majorant = c.tau * double{c.line.intervals[0].bound.upper};
  double rate = majorant, weight = 1;
  for (double x = 0;;) {
    x += rng.exponential() / rate;
    if (!(x < 1)) return weight;
    const double null = majorant - c.tau * double{c.line.density(x)};
    weight *= null / rate;
    rate = null;
    if (!(rate > 0)) return 0;
  }
}

TEST(AdaptiveRatioTracking, IsBiasedWithoutTheMajorantInItsWeights) {
  // Negative control.
  const TrackingCase c = trackingCase(shape("rising"), 1, 1.5);
  const auto wrong = runZTest([&](Rng& rng) { return withoutMajorant(c, rng); }, std::exp(-1.), kSeed, 20000);
  EXPECT_GT(std::abs(wrong.z()), kMaxAbsZ) << wrong;
  expectMean(measure(AdaptiveRatioTracking(), c.line, 1, 20000, kSeed).value, std::exp(-1.), kSeed, c.name);
}

TEST(AdaptiveRatioTracking, LeavesOpaqueMediaEarly) {
  // The constant medium: once for the first collision's factor, then nothing is left to be looked up.
  for (const double control : {1., 1.01, 3.}) {
    const TrackingCase c = trackingCase(shape("constant"), 1e6, control);
    Rng rng(kSeed);
    const auto estimate = runEstimator(AdaptiveRatioTracking(), c.line, Channels<1>{1e6}, rng);
    EXPECT_EQ(estimate.value[0], 0) << control;
    EXPECT_LT(estimate.tally.lookups, 3000u) << control;
  }
}

TEST(AdaptiveRatioTracking, KeepsTheDigitsOfAThinMedium) {
  // A step of length 1 - x at the extinction of the collision: 1 - T to full precision, under a bound 1e3
  // times too high.
  const TrackingCase c = trackingCase(shape("constant"), 1e-6, 1e3);
  Rng rng(kSeed);
  int seen = 0;
  for (int i = 0; i < 20000; ++i) {
    const RecordingLine line(c.line);
    const double value = runEstimator(AdaptiveRatioTracking(), line, Channels<1>{1e-6}, rng).value[0];
    if (line.points.size() != 1) continue;
    ++seen;
    const double exact = 1e-3 + (1 - 1e-3) * -std::expm1(-1e-6 * (1 - line.points[0]));
    ASSERT_NEAR((1 - value) / exact, 1, 1e-12);
  }
  EXPECT_GT(seen, 5);
}

TEST(AdaptiveRatioTracking, EndsAtItsLimitWithTheWeightSoFar) {
  const TrackingCase c = trackingCase(shape("constant"), 1, 1000);
  const RecordingLine line(c.line);
  Rng rng(kSeed);
  const auto estimate = runEstimator(AdaptiveRatioTracking{.maxLookups = 5}, line, Channels<1>{1}, rng);
  EXPECT_EQ(estimate.tally.lookups, 5u);
  EXPECT_EQ(estimate.tally.capped, 1u);
  EXPECT_NEAR(estimate.value[0], .999 * std::exp(-(line.points[4] - line.points[0])), 1e-12);
}

}  // namespace
}  // namespace pbrtmedia
