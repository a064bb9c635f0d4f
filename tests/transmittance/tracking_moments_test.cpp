// SPDX-License-Identifier: BSD-2-Clause
// Mean, second moment and cost of the tracking estimators against theory, over shapes, thicknesses, bounds.
#include <gtest/gtest.h>

#include "tracking_cases.h"
#include "transmittance/estimators/adaptive_ratio_tracking.h"
#include "transmittance/estimators/johnson.h"
#include "transmittance/estimators/p_series_ratio.h"
#include "transmittance/estimators/p_series_residual.h"
#include "transmittance/estimators/random_medium.h"
#include "transmittance/estimators/ratio_tracking.h"
#include "transmittance/estimators/residual_ratio_tracking.h"
#include "transmittance/estimators/residual_track_length.h"
#include "transmittance/estimators/track_length.h"

namespace pbrtmedia {
namespace {

using namespace test;

constexpr std::uint64_t kSeed = 20261106;

/// Rare events carry the moments of thick media.
int runs(const TrackingCase& c) { return c.tau > 5 ? 20000 : 5000; }

/// E[estimate^power] of ratio tracking above minorants, for any extinction and any controls: the generating
/// functional of the Poisson process.
double moment(const TrackingCase& c, int power) {
  return std::exp(c.integrate([power](double mu, double upper, double lower) {
    if (!(upper > lower)) return -power * mu;
    const double rate = upper - lower, factor = (upper - mu) / rate;
    return -power * lower + rate * (std::pow(factor, power) - 1);
  }));
}
MomentsInTheory ratioMoments(const TrackingCase& c) { return {std::exp(-c.tau), moment(c, 2), moment(c, 4)}; }
/// Of a value that is `high` or 0, with mean T.
MomentsInTheory twoValued(double mean, double high) { return {mean, mean * high, mean * high * high * high}; }

/// A weight of exactly 0.
bool hits(double mu, double upper) { return !(mu < upper) && !(mu > upper); }
/// Look-ups of a walk that ends where its weight gets 0.
double walkCost(const TrackingCase& c) {
  const auto rate = [](double, double upper, double lower) { return upper - lower; };
  return c.integrateAttenuated(rate, [&](double mu, double upper, double lower) {
    return hits(mu, upper) ? rate(mu, upper, lower) : 0.;
  });
}
/// Look-ups of k unordered points, of which each ends the series with probability p.
double seriesCost(const TrackingCase& c) {
  const double mean = c.integrate([](double, double upper, double lower) { return upper - lower; });
  const double deadly = c.integrate(
      [&](double mu, double upper, double lower) { return hits(mu, upper) ? upper - lower : 0.; });
  return deadly > 0 ? mean * -std::expm1(-deadly) / deadly : mean;
}

TEST(TrackingMoments, AreThoseOfTheReferences) {
  // exp(-majorant - minorant + integral of (majorant - mu)^2 / (majorant - minorant)), Georgiev et al. 2019.
  for (const auto& c : boundedCases(.5)) {
    const double second = c.integrate([](double mu, double upper, double lower) {
      return upper > lower ? -upper - lower + (upper - mu) * (upper - mu) / (upper - lower) : -2 * mu;
    });
    EXPECT_NEAR(moment(c, 2) / std::exp(second), 1, 1e-9) << c.name;
    EXPECT_NEAR(moment(c, 1) / std::exp(-c.tau), 1, 1e-5) << c.name;
  }
}

TEST(TrackingMoments, HaveClosedFormsUnderProportionalBounds) {
  // Georgiev et al. 2019, appendix D: bounds in proportion to the density, here both constant.
  for (const double tau : {.05, .5, 2.3, 6.}) {
    for (const double control : {1., 1.5, 5.}) {
      const double t = std::exp(-tau), majorant = tau * control, minorant = .4 * tau;
      TrackingCase c = trackingCase(shape("constant"), tau, control);
      EXPECT_NEAR((moment(c, 2) - t * t) / (t * t * std::expm1(tau * tau / majorant)), 1, 1e-9) << c.name;
      const double cost = c.integrateAttenuated([](double, double upper, double) { return upper; },
                                                [](double mu, double, double) { return mu; });
      EXPECT_NEAR(cost / (majorant * (1 - t) / tau), 1, 1e-6) << c.name;
      c = trackingCase(shape("constant"), tau, control, 1, .4);
      const double excess = majorant - minorant;
      EXPECT_NEAR((moment(c, 2) - t * t) / (t * t * std::expm1(std::pow(tau - minorant, 2) / excess)), 1,
                  1e-6)
          << c.name;
      if (control > 1) {
        EXPECT_NEAR(walkCost(c) / excess, 1, 1e-6) << c.name;
      }
    }
  }
}

TEST(TrackingMoments, Ratio) {
  for (const auto& c : boundedCases()) {
    expectMoments(measure(RatioTracking(), c.line, c.tau, runs(c), kSeed), ratioMoments(c), walkCost(c),
                  c.name);
  }
  for (const auto& c : lowControlCases()) {
    expectMoments(measure(RatioTracking(), c.line, c.tau, runs(c), kSeed), ratioMoments(c), walkCost(c),
                  c.name);
  }
}

TEST(TrackingMoments, ResidualRatio) {
  for (const double share : {.5, 1.}) {
    for (const auto& c : boundedCases(share)) {
      expectMoments(measure(ResidualRatioTracking(), c.line, c.tau, runs(c), kSeed), ratioMoments(c),
                    walkCost(c), c.name);
    }
  }
  for (const auto& c : lowControlCases(.5)) {
    expectMoments(measure(ResidualRatioTracking(), c.line, c.tau, runs(c), kSeed), ratioMoments(c),
                  walkCost(c), c.name);
  }
}

TEST(TrackingMoments, PSeriesRatio) {
  for (const auto& c : boundedCases()) {
    expectMoments(measure(PSeriesRatio(), c.line, c.tau, runs(c), kSeed), ratioMoments(c), seriesCost(c),
                  c.name);
  }
  for (const auto& c : lowControlCases()) {
    expectMoments(measure(PSeriesRatio(), c.line, c.tau, runs(c), kSeed), ratioMoments(c), seriesCost(c),
                  c.name);
  }
}

TEST(TrackingMoments, PSeriesResidual) {
  for (const auto& c : boundedCases(.8)) {
    expectMoments(measure(PSeriesResidual(), c.line, c.tau, runs(c), kSeed), ratioMoments(c), seriesCost(c),
                  c.name);
  }
  for (const auto& c : lowControlCases(.5)) {
    expectMoments(measure(PSeriesResidual(), c.line, c.tau, runs(c), kSeed), ratioMoments(c), seriesCost(c),
                  c.name);
  }
}

TEST(TrackingMoments, TrackLength) {
  for (const auto& c : boundedCases()) {
    const double cost = c.integrateAttenuated([](double, double upper, double) { return upper; },
                                              [](double mu, double, double) { return mu; });
    expectMoments(measure(TrackLength(), c.line, c.tau, runs(c), kSeed), twoValued(std::exp(-c.tau), 1), cost,
                  c.name);
  }
}

TEST(TrackingMoments, ResidualTrackLength) {
  for (const auto& c : boundedCases(.8)) {
    const double cost =
        c.integrateAttenuated([](double, double upper, double lower) { return upper - lower; },
                              [](double mu, double, double lower) { return mu - lower; });
    const double minorant = c.integrate([](double, double, double lower) { return lower; });
    expectMoments(measure(ResidualTrackLength(), c.line, c.tau, runs(c), kSeed),
                  twoValued(std::exp(-c.tau), std::exp(-minorant)), cost, c.name);
  }
}

TEST(TrackingMoments, Johnson) {
  for (const std::uint32_t n : {2u, 5u}) {
    for (const auto& c : boundedCases()) {
      const auto power = [&](int k) { return std::exp(n * c.tau * (std::pow(1 - 1. / n, k) - 1)); };
      const double cost = n * c.integrate([](double, double upper, double) { return upper; });
      expectMoments(measure(Johnson{.n = n}, c.line, c.tau, runs(c) / static_cast<int>(n), kSeed),
                    {power(1), power(2), power(4)}, cost, c.name);
    }
  }
}

TEST(TrackingMoments, AdaptiveRatio) {
  // No closed form for the second moment or the cost: the table below has measured ones.
  for (const auto& c : boundedCases()) {
    const Moments m = measure(AdaptiveRatioTracking(), c.line, c.tau, runs(c), kSeed);
    expectMean(m.value, std::exp(-c.tau), kSeed, c.name);
    EXPECT_LT(zTest(m.square, std::exp(-c.tau), kSeed).z(), kMaxAbsZ) << c.name << ": above T - T^2";
    EXPECT_LE(m.lookups.mean(), c.integrate([](double, double upper, double) { return upper; }) +
                                    kMaxAbsZ * m.lookups.standardError())
        << c.name;
  }
  for (const auto& c : lowControlCases()) {
    expectMean(measure(AdaptiveRatioTracking(), c.line, c.tau, 2 * runs(c), kSeed).value, std::exp(-c.tau),
               kSeed, c.name);
  }
}

TEST(TrackingMoments, RandomMedium) {
  for (const auto& c : boundedCases(.8)) {
    expectMean(measure(RandomMedium(), c.line, c.tau, runs(c), kSeed).value, std::exp(-c.tau), kSeed, c.name);
  }
  for (const auto& c : lowControlCases(.5)) {
    expectMean(measure(RandomMedium(), c.line, c.tau, runs(c), kSeed).value, std::exp(-c.tau), kSeed, c.name);
  }
}

/// A row of table 2.5: shape, T aimed at, tau / control, then variance and cost as printed.
struct Row {
  const char* shape;
  double target, ratio, deltaVariance, deltaCost, ratioVariance, ratioCost;
};
constexpr Row kRows[] = {
    {"constant", .9, .95, 9.00e-2, .105, 8.53e-2, .111},
    {"constant", .5, .95, 2.50e-1, .526, 2.33e-1, .730},
    {"constant", .5, .475, 2.50e-1, 1.05, 9.75e-2, 1.46},
    {"constant", .1, .475, 9.00e-2, 1.90, 1.99e-2, 4.85},
    {"cosine", .9, .45, 9.08e-2, .223, 5.96e-2, .234},
    {"cosine", .5, .45, 2.50e-1, 1.137, 1.470e-1, 1.540},
    {"cosine", .5, .225, 2.50e-1, 2.274, 6.494e-2, 3.081},
    {"cosine", .1, .45, 8.81e-2, 2.154, 3.554e-2, 5.117},
    {"gaussian", .9, .12, 9.00e-2, .818, 5.99e-2, .878},
    {"gaussian", .5, .12, 2.50e-1, 3.784, 1.497e-1, 5.776},
    {"gaussian", .1, .12, 9.00e-2, 6.923, 3.754e-2, 19.19},
    {"hole", .5, .85, 2.50e-1, .598, 2.267e-1, .815},
    {"hole", .1, .85, 9.00e-2, 1.099, 7.531e-2, 2.709},
    {"rising", .5, .45, 2.50e-1, 1.248, 1.289e-1, 1.540},
    {"rising", .1, .45, 9.00e-2, 2.893, 2.981e-2, 5.117},
};

TEST(TrackingMoments, AgreeWithTheCanonicalMap) {
  // Georgiev et al. 2019, figure 7, as computed independently. The cosine keeps its own integral of 1.010572
  // per unit of tau asked for.
  for (const Row& row : kRows) {
    const double tau = -std::log(row.target);
    const Shape s = shape(row.shape);
    const double scale = s.name == "cosine" ? 1 + (std::sin(20.8) - std::sin(.8)) / 20 : 1;
    TrackingCase c = trackingCase(s, scale * tau, 1);
    c.line.intervals[0].bound.upper = static_cast<float>(1 / (row.ratio * scale));
    const double t = std::exp(-c.tau);
    const double cost = c.integrateAttenuated([](double, double upper, double) { return upper; },
                                              [](double mu, double, double) { return mu; });
    constexpr double kPrinted = 6e-3;  // three digits, or four
    EXPECT_NEAR(moment(c, 2) - t * t, row.ratioVariance, kPrinted * row.ratioVariance) << c.name;
    EXPECT_NEAR(walkCost(c), row.ratioCost, kPrinted * row.ratioCost) << c.name;
    EXPECT_NEAR(t - t * t, row.deltaVariance, kPrinted * row.deltaVariance) << c.name;
    EXPECT_NEAR(cost, row.deltaCost, kPrinted * row.deltaCost) << c.name;
    expectMoments(measure(RatioTracking(), c.line, c.tau, 30000, kSeed), ratioMoments(c), walkCost(c),
                  c.name);
    expectMoments(measure(TrackLength(), c.line, c.tau, 30000, kSeed), twoValued(t, 1), cost, c.name);
  }
}

/// Ten sines of Misso et al. 2023, figure 8: period, phase, amplitude.
double composedSines(double x) {
  constexpr double kSines[][3] = {{.459536, 3.835247, .373294}, {.366002, 1.978004, .421999},
                                  {.495886, 1.230734, .306225}, {.334674, 3.250040, .052114},
                                  {.179380, 1.203935, .205598}, {.472080, 2.554358, .129045},
                                  {.211228, 3.173115, .041064}, {.094325, 2.238707, .233507},
                                  {.458915, 1.589567, .121171}, {.052476, 1.855387, .169688}};
  double sum = 0;
  for (const auto& [period, phase, amplitude] : kSines) {
    sum += amplitude / 2 * (1 + std::sin(2 * std::acos(-1.) * x / period + phase));
  }
  return sum;
}

TEST(TrackingMoments, AdaptiveRatioAgreesWithItsTable) {
  // Misso et al. 2023, figure 8: bounds 1.5 times the maximum, tau = 1; mean squared errors and costs from
  // 2e7 runs of an independent computation, errors below the last digit.
  const auto bell = [](double x) { return 2.0627 * std::exp(-(x - .63) * (x - .63) / (2 * .2 * .2)); };
  const struct {
    std::string name;
    std::function<double(double)> f;
    double bound, mse, cost, adaptiveMse, adaptiveCost;
  } rows[] = {{"constant", [](double) { return 1.; }, 1.5, .12826, 1.500, .11707, 1.018},
              {"composed sines", composedSines, 1.5 * 1.6463, .07161, 2.469, .04868, 1.832},
              {"gaussian", bell, 3.094, .08454, 3.094, .06177, 2.462},
              {"linear", [](double x) { return 2 * x; }, 3, .07575, 3.000, .03971, 2.483}};
  constexpr double kStandardErrors = 4;
  for (const auto& row : rows) {
    EXPECT_NEAR(simpson(row.f, 0, 1), 1, 2e-4) << row.name;
    const ProvenLine line{{row.f, {{1, {static_cast<float>(row.bound), 0}}}}};
    constexpr int kRuns = 400000;
    const Moments plain = measure(RatioTracking(), line, 1, kRuns, kSeed),
                  adaptive = measure(AdaptiveRatioTracking(), line, 1, kRuns, kSeed + 1);
    const double truth = std::exp(-simpson(row.f, 0, 1));
    expectMean(adaptive.value, truth, kSeed, row.name);
    const auto near = [&](const RunningStats& found, double printed, double half, const std::string& what) {
      EXPECT_LT(std::abs(found.mean() - printed), kStandardErrors * found.standardError() + half)
          << row.name << what << ": " << found.mean() << " +- " << found.standardError();
    };
    const auto mse = [&](const Moments& m, double printed, const std::string& what) {
      // E[(X - T)^2] = E[X^2] - T^2 for the unbiased; its error is that of the squares.
      EXPECT_LT(std::abs(m.square.mean() - truth * truth - printed),
                kStandardErrors * m.square.standardError() + 5e-6)
          << row.name << what << ": " << m.square.mean() - truth * truth << " +- "
          << m.square.standardError();
    };
    near(plain.lookups, row.cost, 5e-4, ", ratio, cost");
    near(adaptive.lookups, row.adaptiveCost, 5e-4, ", adaptive, cost");
    mse(plain, row.mse, ", ratio, error");
    mse(adaptive, row.adaptiveMse, ", adaptive, error");
    const double gain =
        plain.value.variance() * plain.lookups.mean() / (adaptive.value.variance() * adaptive.lookups.mean());
    EXPECT_NEAR(gain, row.mse * row.cost / (row.adaptiveMse * row.adaptiveCost), .03) << row.name;
  }
}

TEST(TrackingMoments, RejectASecondMomentTwoPerCentOff) {
  // Negative control of every second moment here.
  const TrackingCase c = trackingCase(shape("rising"), .5, 1.5);
  const Moments m = measure(RatioTracking(), c.line, c.tau, 200000, kSeed);
  EXPECT_GT(std::abs(zTest(m.square, 1.02 * moment(c, 2), kSeed).z()), kMaxAbsZ);
}

}  // namespace
}  // namespace pbrtmedia
