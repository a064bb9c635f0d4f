// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <ostream>
#include <span>
#include <stdexcept>
#include <vector>

namespace pbrtmedia::test {

/// Smallest p-value that passes: as rare as |z| = kMaxAbsZ.
inline constexpr double kMinPValue = 5.733e-7;

/// Level for each of `tests` independent tests so that all together have level `alpha`.
/// Šidák 1967, doi:10.1080/01621459.1967.10482935.
inline double sidak(double alpha, std::size_t tests) {
  return -std::expm1(std::log1p(-alpha) / static_cast<double>(tests));
}

/// Regularised upper incomplete gamma function Q(a, x), a > 0, x >= 0: power series below a + 1, continued
/// fraction (modified Lentz) above; relative error about 1e-12. DLMF 8.11.4 and 8.9.2.
inline double gammaQ(double a, double x) {
  if (!(x > 0)) return 1;
  if (std::isinf(x)) return 0;
  const double prefactor = std::exp(a * std::log(x) - x - std::lgamma(a));
  constexpr double kEps = 1e-15;
  constexpr int kMaxTerms = 100000;
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int k = 1; k < kMaxTerms && term > sum * kEps; ++k) sum += term *= x / (a + k);
    return std::max(0.0, 1 - prefactor * sum);
  }
  constexpr double kTiny = 1e-300;
  double b = x + 1 - a, c = 1 / kTiny, d = 1 / b, h = d;
  for (int k = 1; k < kMaxTerms; ++k) {
    const double an = -k * (k - a);
    b += 2;
    d = an * d + b;
    d = 1 / (std::abs(d) < kTiny ? kTiny : d);
    c = b + an / c;
    c = std::abs(c) < kTiny ? kTiny : c;
    const double delta = c * d;
    h *= delta;
    if (std::abs(delta - 1) < kEps) break;
  }
  return prefactor * h;
}

/// Pearson's test of observed counts against expected ones.
struct ChiSquareTest {
  double statistic = 0;
  std::size_t degreesOfFreedom = 0;
  std::size_t pooledBins = 0;  ///< bins that were joined because their expectation was too small
  double observedTotal = 0, expectedTotal = 0;
  bool impossible =
      false;  ///< something was counted where nothing is expected, or an expectation is not a number

  /// Probability of a statistic at least this large.
  double pValue() const {
    if (impossible || std::isnan(statistic)) return 0;
    return gammaQ(0.5 * static_cast<double>(degreesOfFreedom), 0.5 * statistic);
  }
  friend std::ostream& operator<<(std::ostream& os, const ChiSquareTest& t) {
    const auto old = os.precision(9);
    os << "chi-square " << t.statistic << ", degrees of freedom " << t.degreesOfFreedom << ", p "
       << t.pValue() << ", observed " << t.observedTotal << ", expected " << t.expectedTotal
       << ", pooled bins " << t.pooledBins << (t.impossible ? ", counts in a bin of expectation 0" : "");
    os.precision(old);
    return os;
  }
};

/// Bins with an expected count below `minExpected` are pooled, smallest first; what is left of the last pool
/// joins the last bin, so nothing is thrown away. `constraints`: how many numbers of the expectation were
/// taken from the observations (1: only the total). Throws std::invalid_argument when fewer bins than
/// constraints + 1 are left: such a test could not fail.
inline ChiSquareTest chiSquareTest(std::span<const double> observed, std::span<const double> expected,
                                   double minExpected = 5, std::size_t constraints = 1) {
  if (observed.size() != expected.size() || observed.empty())
    throw std::invalid_argument("chiSquareTest: observed and expected need the same size > 0");
  ChiSquareTest test;
  std::vector<std::size_t> order(observed.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
  double poolObserved = 0, poolExpected = 0, lastObserved = 0, lastExpected = 0;
  std::size_t used = 0, members = 0;
  if (std::any_of(expected.begin(), expected.end(), [](double e) { return !(e >= 0); })) {
    test.impossible = true;
    return test;
  }
  const auto term = [](double o, double e) { return (o - e) * (o - e) / e; };
  for (const std::size_t i : order) {
    test.observedTotal += observed[i];
    test.expectedTotal += expected[i];
    if (expected[i] == 0 && observed[i] > 0) test.impossible = true;
    poolObserved += observed[i];
    poolExpected += expected[i];
    ++members;
    if (poolExpected >= minExpected) {
      if (members > 1) test.pooledBins += members;
      test.statistic += term(poolObserved, poolExpected);
      lastObserved = poolObserved;
      lastExpected = poolExpected;
      ++used;
      poolObserved = poolExpected = 0;
      members = 0;
    }
  }
  if (members > 0 && used > 0) {
    test.statistic +=
        term(lastObserved + poolObserved, lastExpected + poolExpected) - term(lastObserved, lastExpected);
    test.pooledBins += members;
  }
  if (test.impossible) return test;
  if (used <= constraints)
    throw std::invalid_argument("chiSquareTest: too few expected counts to test anything");
  test.degreesOfFreedom = used - constraints;
  return test;
}

/// Counts that should all be equal.
inline ChiSquareTest chiSquareUniform(std::span<const double> observed) {
  const double total = std::accumulate(observed.begin(), observed.end(), 0.0);
  const std::vector<double> expected(observed.size(), total / static_cast<double>(observed.size()));
  return chiSquareTest(observed, expected);
}

}  // namespace pbrtmedia::test
