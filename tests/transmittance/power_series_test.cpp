// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/power_series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/rng.h"
#include "support/printed.h"
#include "support/roulette_moments.h"
#include "support/statistics.h"
#include "transmittance/parts/scaled_double.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::Printed;
using test::RouletteMoments;

TEST(ScaledDouble, CalculatesLikeDoubleWithinItsRange) {
  Rng rng(1);
  for (int i = 0; i < 10000; ++i) {
    const double a = std::exp(40 * rng.uniformDouble() - 20) - 1,
                 b = 1 - std::exp(40 * rng.uniformDouble() - 20);
    EXPECT_EQ((ScaledDouble(a) * b).value(), a * b);
    ScaledDouble sum = a;
    sum += b;
    EXPECT_EQ(sum.value(), a + b);
  }
  EXPECT_EQ(ScaledDouble(0).value(), 0.0);
  EXPECT_EQ((ScaledDouble(3) * 0).value(), 0.0);
  EXPECT_EQ(ScaledDouble::exp(-1.25).value(), std::exp(-1.25));
}

TEST(ScaledDouble, GoesFarBeyondTheRangeOfDouble) {
  ScaledDouble product = 1;
  for (int i = 0; i < 1000; ++i) product *= 1e300;
  EXPECT_TRUE(std::isinf(product.value()));
  for (int i = 0; i < 1000; ++i) product *= 1e-300;
  EXPECT_NEAR(product.value(), 1, 1e-12);
  for (const double x : {650., 1e4, 1e6, 1e9}) {
    EXPECT_NEAR((ScaledDouble::exp(x) * ScaledDouble::exp(-x)).value(), 1, x * 1e-15);
    EXPECT_NEAR((ScaledDouble::exp(x) * ScaledDouble::exp(1 - x)).value(), std::exp(1.), 4 * x * 1e-15);
  }
  ScaledDouble sum = ScaledDouble::exp(1e6);
  sum += 1.0;
  sum += ScaledDouble::exp(1e6) * -1.0;
  EXPECT_EQ(sum.value(), 0.0);  // 1 is lost, as it is in any floating-point sum
  EXPECT_EQ(ScaledDouble::exp(-1e6).value(), 0.0);
}

/// The symmetric series from its definition: all choices of k out of the differences.
double seriesByEnumeration(const std::vector<double>& y, const OrderRoulette& roulette) {
  const std::size_t n = y.size();
  std::vector<double> sums(n + 1), counts(n + 1);
  for (unsigned choice = 0; choice < 1u << n; ++choice) {
    double product = 1;
    std::size_t k = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (choice >> i & 1u) {
        product *= y[i];
        ++k;
      }
    }
    sums[k] += product;
    ++counts[k];
  }
  double total = 0, weight = 1;
  for (std::size_t k = 0; k <= n; ++k) {
    if (k > 0) weight *= roulette.termFactor(k);
    total += weight * sums[k] / counts[k];
  }
  return total;
}

TEST(PowerSeries, IsTheMeanOverAllChoicesOfFactors) {
  Rng rng(2);
  const OrderRoulette roulette = OrderRoulette::aggressive(2, .9);
  const std::vector<double> sigma{0, .7, 3};
  for (std::size_t n = 1; n <= 10; ++n) {
    std::vector<double> columns(n), out(3);
    for (double& f : columns) f = 2 * rng.uniformDouble();
    symmetricSeries(columns, 1.3, roulette, sigma, out);
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<double> y;
      for (const double f : columns) y.push_back(sigma[c] * (1.3 - f));
      const double expected = std::exp(-sigma[c] * 1.3) * seriesByEnumeration(y, roulette);
      EXPECT_NEAR(out[c], expected, 1e-13 * std::abs(expected) + 1e-15) << n;
    }
    if (n < 2) continue;
    symmetricSeriesAboutEach(columns, roulette, sigma, out);
    for (std::size_t c = 0; c < 3; ++c) {
      double expected = 0;
      for (std::size_t p = 0; p < n; ++p) {
        std::vector<double> y;
        for (std::size_t i = 0; i < n; ++i) {
          if (i != p) y.push_back(sigma[c] * (columns[p] - columns[i]));
        }
        expected +=
            std::exp(-sigma[c] * columns[p]) * seriesByEnumeration(y, roulette) / static_cast<double>(n);
      }
      EXPECT_NEAR(out[c], expected, 1e-13 * std::abs(expected) + 1e-14) << n;
    }
  }
}

TEST(PowerSeries, OfPlainProductsIsTheirSum) {
  const OrderRoulette roulette = OrderRoulette::bhanotKennedy(2);
  ProductSeries<2> series({1, .5}, 2);
  series.multiply(.5, roulette.termFactor(1));
  series.addTerm();
  series.multiply(3, roulette.termFactor(2));
  series.addTerm();
  series.multiply(1, roulette.termFactor(3));
  series.addTerm();
  // Y = 1.5, -1, 1; weights 1, 1/2, 1/(2 c) = 1/4.
  EXPECT_NEAR(series.value()[0], std::exp(-2.) * (1 + 1.5 - .75 - .375), 1e-16);
  EXPECT_NEAR(series.value()[1], std::exp(-1.) * (1 + .75 - .1875 - .046875), 1e-16);
}

TEST(PowerSeries, KeepsItsDigitsWhereFactorialsAndExponentialsDoNot) {
  // Y = tau for all: e^{-2 tau} (sum of tau^k / k!) = e^{-tau}, with orders far beyond 170.
  for (const double tau : {300., 700., 1500.}) {
    const std::vector<double> columns(static_cast<std::size_t>(tau + 20 * std::sqrt(tau)), tau);
    std::vector<double> out(1);
    const OrderRoulette all{columns.size(), 1, 1};
    symmetricSeries(columns, 2 * tau, all, std::vector<double>{1}, out);
    EXPECT_NEAR(out[0], std::exp(-tau), std::exp(-tau) * tau * 1e-14) << tau;
    ProductSeries<1> series({1}, 2 * tau);
    for (std::size_t k = 1; k <= columns.size(); ++k) {
      series.multiply(tau, all.termFactor(k));
      series.addTerm();
    }
    EXPECT_NEAR(series.value()[0], std::exp(-tau), std::exp(-tau) * tau * 1e-14) << tau;
  }
}

TEST(PowerSeries, OfWildFactorsIsNeverNotANumber) {
  Rng rng(3);
  for (const double size : {1e3, 1e6, 1e12}) {
    std::vector<double> columns(200), out(1);
    for (double& f : columns) f = size * rng.uniformDouble();
    for (const double pivot : {0., size}) {
      symmetricSeries(columns, pivot, OrderRoulette::bhanotKennedy(2), std::vector<double>{1}, out);
      EXPECT_FALSE(std::isnan(out[0])) << size;
    }
    symmetricSeriesAboutEach(columns, OrderRoulette::bhanotKennedy(2), std::vector<double>{1}, out);
    EXPECT_FALSE(std::isnan(out[0])) << size;
  }
}

// Exact variances, also found by enumerating orders and two-valued Y in rational numbers. m = E[Y].

TEST(RouletteMoments, ReproduceVarianceAgainstPivotInUniformMedia) {
  const double means[] = {-2, -1, -.5, -.1, .1, .5, 1, 2};
  const struct {
    OrderRoulette roulette;
    const char* printed[8];
  } rows[] = {{OrderRoulette::bhanotKennedy(1),
               {"9.98e2", "1.72", "3.48e-2", "2.87e-5", "2.20e-5", "9.02e-3", "1.04e-1", "1.73"}},
              {OrderRoulette::bhanotKennedy(2),
               {"5.36e1", "7.96e-2", "4.87e-4", "1.62e-8", "1.20e-8", "1.08e-4", "3.83e-3", "1.01e-1"}},
              {OrderRoulette::bhanotKennedy(4),
               {"7.33e-1", "1.01e-4", "3.99e-8", "0.00e-8", "0.00e-8", "7.5e-9", "3.58e-6", "8.98e-4"}},
              {OrderRoulette::aggressive(2, .9),
               {"9.03e2", "2.74e1", "3.79", "9.95e-2", "8.15e-2", "1.39", "3.63", "7.74"}}};
  for (const auto& row : rows) {
    const RouletteMoments moments(row.roulette, 150);
    for (std::size_t i = 0; i < 8; ++i) {
      const double m = means[i];
      const double relative = std::exp(-2 * m) * moments.productSecondMoment(m, 0) - 1;
      EXPECT_TRUE(Printed(row.printed[i]).agreesWith(relative))
          << m << ": " << relative << ", " << row.printed[i];
    }
  }
}

TEST(RouletteMoments, ReproduceVarianceInFluctuatingMedia) {
  const double means[] = {-1, -.3, 0, .3, 1};
  const struct {
    double variance;
    const char *product[5], *symmetric[5];
  } rows[] = {{0,
               {"1.077e-2", "2.194e-6", "0", "8.91e-7", "5.185e-4"},
               {"1.077e-2", "2.194e-6", "0", "8.91e-7", "5.185e-4"}},
              {1e-4,
               {"1.083e-2", "2.11e-5", "1.353e-5", "1.12e-5", "5.25e-4"},
               {"1.078e-2", "6.87e-6", "4.77e-6", "5.59e-6", "5.23e-4"}},
              {1e-2,
               {"1.668e-2", "1.895e-3", "1.357e-3", "1.034e-3", "1.181e-3"},
               {"1.150e-2", "4.72e-4", "4.79e-4", "4.72e-4", "9.52e-4"}},
              {.1,
               {"7.19e-2", "1.941e-2", "1.388e-2", "1.055e-2", "7.27e-3"},
               {"1.90e-2", "4.93e-3", "4.94e-3", "4.83e-3", "4.93e-3"}},
              {1,
               {"8.65e-1", "2.52e-1", "1.756e-1", "1.309e-1", "8.21e-2"},
               {"2.12e-1", "7.69e-2", "6.81e-2", "6.23e-2", "5.41e-2"}}};
  const RouletteMoments moments(OrderRoulette::bhanotKennedy(2), 40);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < 5; ++i) {
      const double m = means[i], scale = std::exp(-2 - 2 * m), truth = std::exp(-2.);
      const double product = scale * moments.productSecondMoment(m, row.variance) - truth;
      const double symmetric = scale * moments.symmetricSecondMoment(m, row.variance) - truth;
      if (row.variance == 0 && m == 0) {
        EXPECT_NEAR(product, 0, 1e-16);
        EXPECT_NEAR(symmetric, 0, 1e-16);
        continue;
      }
      EXPECT_TRUE(Printed(row.product[i]).agreesWith(product))
          << row.variance << ", " << m << ": " << product;
      EXPECT_TRUE(Printed(row.symmetric[i]).agreesWith(symmetric))
          << row.variance << ", " << m << ": " << symmetric;
      EXPECT_LE(symmetric, product + 1e-15);
    }
  }
}

TEST(RouletteMoments, ReproduceVarianceAgainstCost) {
  const struct {
    double c;
    const char *productMajorant, *symmetricMajorant, *productTruth, *symmetricTruth;
  } rows[] = {
      {.5, "5.51e-1", "5.34e-1", "2.33e-1", "2.04e-1"},  {1, "7.59e-2", "6.81e-2", "8.78e-2", "6.41e-2"},
      {2, "3.72e-2", "2.45e-2", "7.69e-2", "2.84e-2"},   {4, "3.52e-2", "1.29e-2", "7.66e-2", "1.30e-2"},
      {8, "3.519e-2", "6.60e-3", "7.661e-2", "6.60e-3"}, {16, "3.519e-2", "3.43e-3", "7.661e-2", "3.43e-3"}};
  const double truth = std::exp(-2.), variance = .5;
  for (const auto& row : rows) {
    const RouletteMoments moments(OrderRoulette::bhanotKennedy(row.c), 60);
    const auto agrees = [&](const char* printed, double secondMoment, double pivotDepth) {
      const double computed = std::exp(-2 * pivotDepth) * secondMoment - truth;
      EXPECT_TRUE(Printed(printed).agreesWith(computed)) << row.c << ": " << computed << ", " << printed;
    };
    agrees(row.productMajorant, moments.productSecondMoment(1, variance), 2);
    agrees(row.symmetricMajorant, moments.symmetricSecondMoment(1, variance), 2);
    agrees(row.productTruth, moments.productSecondMoment(0, variance), 1);
    agrees(row.symmetricTruth, moments.symmetricSecondMoment(0, variance), 1);
  }
}

/// The series itself, fed with two-valued Y of mean m and variance s^2, has these moments.
TEST(RouletteMoments, AreThoseOfTheSeries) {
  const OrderRoulette roulette = OrderRoulette::bhanotKennedy(2);
  const RouletteMoments moments(roulette, 60);
  for (const auto& [m, deviation] : {std::pair{0., 1.}, {.5, .7}, {-.5, .3}, {1., .1}}) {
    Rng rng(7);
    test::RunningStats product, symmetric, mean;
    for (int i = 0; i < 100000; ++i) {
      const std::uint64_t order = roulette.draw(1 - rng.uniformDouble());
      std::vector<double> y(static_cast<std::size_t>(order)), out(1);
      ProductSeries<1> series({1}, 0);
      for (std::size_t k = 0; k < y.size(); ++k) {
        y[k] = -(m + (rng.uniformDouble() < .5 ? -deviation : deviation));
        series.multiply(y[k], roulette.termFactor(k + 1));
        series.addTerm();
      }
      out[0] = 1;
      if (order > 0) symmetricSeries(y, 0, roulette, std::vector<double>{1}, out);
      product.add(series.value()[0] * series.value()[0]);
      symmetric.add(out[0] * out[0]);
      mean.add(out[0]);
    }
    const double variance = deviation * deviation;
    const auto zProduct = test::zTest(product, moments.productSecondMoment(m, variance), 7);
    const auto zSymmetric = test::zTest(symmetric, moments.symmetricSecondMoment(m, variance), 7);
    const auto zMean = test::zTest(mean, std::exp(m), 7);
    EXPECT_LT(std::abs(zProduct.z()), kMaxAbsZ) << m << ": " << zProduct;
    EXPECT_LT(std::abs(zSymmetric.z()), kMaxAbsZ) << m << ": " << zSymmetric;
    EXPECT_LT(std::abs(zMean.z()), kMaxAbsZ) << m << ": " << zMean;
  }
}

}  // namespace
}  // namespace pbrtmedia
