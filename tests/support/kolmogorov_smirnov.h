// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <vector>

namespace pbrtmedia::test {

/// Largest distance between the empirical and the true distribution function of one variable.
struct KsTest {
  double distance = 0;
  std::size_t n = 0;

  /// Probability of a distance at least this large, from the limit law with the finite-n correction of
  /// Stephens 1970 (doi:10.1111/j.2517-6161.1970.tb00821.x); good to a few per cent for n >= 10.
  double pValue() const {
    if (std::isnan(distance)) return 0;
    const double root = std::sqrt(static_cast<double>(n)), x = (root + 0.12 + 0.11 / root) * distance;
    if (x < 0.2) return 1;  // the series below needs many terms there, and is 1 to 12 digits
    double sum = 0;
    for (int k = 1; k <= 100; ++k) {
      const double term = std::exp(-2.0 * k * k * x * x);
      sum += (k & 1) ? term : -term;
      if (term < 1e-18) break;
    }
    return std::clamp(2 * sum, 0.0, 1.0);
  }
  friend std::ostream& operator<<(std::ostream& os, const KsTest& t) {
    return os << "KS distance " << t.distance << ", n " << t.n << ", p " << t.pValue();
  }
};

/// `cdf(x)` is the true distribution function, continuous and non-decreasing.
template <class Cdf>
KsTest ksTest(std::vector<double> values, Cdf&& cdf) {
  const double n = static_cast<double>(values.size());
  for (const double v : values) {
    if (std::isnan(v)) return {std::numeric_limits<double>::quiet_NaN(), values.size()};
  }
  std::sort(values.begin(), values.end());
  double distance = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double f = cdf(values[i]);
    if (std::isnan(f)) return {f, values.size()};
    distance = std::max({distance, f - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - f});
  }
  return {distance, values.size()};
}

/// Against the uniform distribution on [0, 1].
inline KsTest ksTestUniform(std::vector<double> values) {
  return ksTest(std::move(values), [](double x) { return std::clamp(x, 0.0, 1.0); });
}

}  // namespace pbrtmedia::test
