// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/poisson.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pbrtmedia {
namespace {

/// Sums of terms until they no longer count need at most about 9 sqrt(mean) terms; above this the expansion
/// for large parameters takes over, whose error is of the order 1 / mean^2.
constexpr double kAsymptotic = 1e6;
/// Below, counting up from 0 is fastest.
constexpr double kCountFromZero = 16;
constexpr double kNegligible = 1e-18;

/// a ln(a / x) + x - a >= 0 without cancellation where a is near x: with v = (a - x) / (a + x),
/// ln(a / x) = 2 artanh v and 2 a v - (a - x) = (a - x) v.
double deviance(double a, double x) {
  const double d = a - x, v = d / (a + x);
  if (std::abs(v) > .05) return a * std::log(a / x) - d;
  double sum = 0, power = v;
  for (int k = 3; k <= 15; k += 2) sum += (power *= v * v) / k;
  return d * v + 2 * a * sum;
}

/// ln k! - ((k + 1/2) ln k - k + ln(2 pi) / 2) for k >= 16: Stirling's series.
double stirlingRemainder(double k) {
  const double r = 1 / k, r2 = r * r;
  return r * (1. / 12 - r2 * (1. / 360 - r2 * (1. / 1260 - r2 * (1. / 1680 - r2 / 1188))));
}

double factorial(std::uint64_t k) {
  double product = 1;
  for (std::uint64_t i = 2; i <= k; ++i) product *= static_cast<double>(i);
  return product;
}

/// Pr{K <= k}, term by term downwards; fast for k < mean.
double sumDown(std::uint64_t k, double mean) {
  double term = poissonPmf(k, mean), sum = term;
  for (double i = static_cast<double>(k); i > 0 && term > kNegligible * sum; --i) sum += term *= i / mean;
  return sum;
}
/// Pr{K >= k}, term by term upwards; fast for k > mean.
double sumUp(std::uint64_t k, double mean) {
  double term = poissonPmf(k, mean), sum = term;
  for (double i = static_cast<double>(k) + 1; term > kNegligible * sum; ++i) sum += term *= mean / i;
  return sum;
}

/// The regularised incomplete gamma functions for large a, x / a between 1/2 and 2. Temme 1979; DLMF 8.12.3,
/// 8.12.4, 8.12.8 and 8.12.10.
struct LargeParameter {
  double half, correction;  ///< Q = half erfc(r) + correction, P = half erfc(-r) - correction

  LargeParameter(double a, double x) {
    const double exponent = deviance(a, x), mu = (x - a) / a;
    const double eta = std::copysign(std::sqrt(2 * exponent / a), mu);
    // Near 0 the closed forms cancel: their Taylor series instead.
    const double c0 =
        std::abs(eta) < .01 ? -1. / 3 + eta * (1. / 12 - eta * (2. / 135 - eta / 864)) : 1 / mu - 1 / eta;
    const double c1 = std::abs(eta) < .01
                          ? -1. / 540 - eta / 288
                          : 1 / (eta * eta * eta) - 1 / (mu * mu * mu) - 1 / (mu * mu) - 1 / (12 * mu);
    half = std::copysign(std::sqrt(exponent), mu);
    correction = std::exp(-exponent) / std::sqrt(2 * std::numbers::pi * a) * (c0 + c1 / a);
  }
  double q() const { return .5 * std::erfc(half) + correction; }
  double p() const { return .5 * std::erfc(-half) - correction; }

  static bool serves(double a, double x) { return x >= kAsymptotic && a > x / 2 && a < 2 * x; }
};

}  // namespace

double poissonPmf(std::uint64_t k, double mean) {
  if (!(mean > 0)) return k == 0 ? 1 : 0;
  const double n = static_cast<double>(k);
  if (k < 16) return std::exp(n * std::log(mean) - mean) / factorial(k);
  return std::exp(-deviance(n, mean) - stirlingRemainder(n)) / std::sqrt(2 * std::numbers::pi * n);
}

double poissonCdf(std::uint64_t k, double mean) {
  const double n = static_cast<double>(k);
  if (LargeParameter::serves(n + 1, mean)) return LargeParameter(n + 1, mean).q();
  return n < mean ? std::min(sumDown(k, mean), 1.0) : 1 - sumUp(k + 1, mean);
}

double poissonTail(std::uint64_t k, double mean) {
  if (k == 0) return 1;
  const double n = static_cast<double>(k);
  if (LargeParameter::serves(n, mean)) return LargeParameter(n, mean).p();
  return n > mean ? std::min(sumUp(k, mean), 1.0) : 1 - sumDown(k - 1, mean);
}

std::uint64_t poissonQuantile(double u, double mean) {
  if (!(mean > 0)) return 0;
  constexpr double kMost = 0x1p62;  // beyond, the quantile and the mean are the same number
  if (mean >= kMost) return std::uint64_t{1} << 62;
  if (mean < kCountFromZero) {
    double term = std::exp(-mean), sum = term, n = 0;
    // Rounding may leave the sum of all terms below u: the end of the terms ends the search.
    while (u >= sum && (n < mean || term > kNegligible)) sum += term *= mean / ++n;
    return static_cast<std::uint64_t>(n);
  }
  if (mean < kAsymptotic) {
    // From the mode, where the distribution function is known without loss, towards u.
    const auto mode = static_cast<std::uint64_t>(mean);
    double n = static_cast<double>(mode), term = poissonPmf(mode, mean), sum = poissonCdf(mode, mean);
    while (u >= sum && term > kNegligible) sum += term *= mean / ++n;
    while (n > 0 && u < sum - term) {
      sum -= term;
      term *= n-- / mean;
      if (term < kNegligible) break;
    }
    return static_cast<std::uint64_t>(n);
  }
  // Doubles have no uniform number further than 8.3 standard deviations from 1; 10 bracket all.
  const double spread = 10 * std::sqrt(mean);
  auto below = static_cast<std::uint64_t>(mean - spread), above = static_cast<std::uint64_t>(mean + spread);
  while (above - below > 1) {
    const std::uint64_t middle = below + (above - below) / 2;
    (poissonCdf(middle, mean) > u ? above : below) = middle;
  }
  return above;
}

}  // namespace pbrtmedia
