// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/control_moments.h"
#include "transmittance/estimators/next_flight.h"
#include "transmittance/estimators/p_series_cmf.h"
#include "transmittance/estimators/p_series_next_flight.h"
#include "transmittance/estimators/unidirectional_mis.h"
#include "transmittance/parts/poisson.h"
#include "transmittance/series_cases.h"

// Closed forms of the prefix-sum estimators, straight from their definitions.
namespace pbrtmedia::test {

/// Look-ups of p-series CMF: K + sum_j prod_{i=1..j} tau_bar / (K + i).
inline double expectedLookups(double depth, std::uint64_t certain) {
  const double k = static_cast<double>(certain);
  double sum = k, term = 1;
  for (double i = 1; term > 1e-18; ++i) sum += term *= std::min(1.0, depth / (k + i));
  return sum;
}

/// E[T^2] for one channel without exact zeros among its weights.
inline double secondMoment(const PSeriesCmf& estimator, const ControlMoments& m) {
  const double certain = static_cast<double>(estimator.certainLevels(m.depth));
  std::vector<double> a, reach;
  double probability = 1;
  for (std::uint64_t k = 0;; ++k) {
    const double order = static_cast<double>(k);
    if (order > certain) probability *= std::min(1.0, m.depth / order);
    a.push_back(poissonPmf(k, m.depth) / probability);  // e^{-tau_bar} tau_bar^k / (k! P_k)
    reach.push_back(probability);
    if (order > certain && probability < 1e-25) break;
  }
  return prefixSumSecondMoment(a, reach, m.mean, m.square);
}

inline double secondMoment(const PSeriesNextFlight&, const ControlMoments& m) {
  std::vector<double> a, reach;
  for (std::uint64_t k = 0;; ++k) {
    const double tail = poissonTail(k, m.depth);
    if (tail < 1e-25) break;
    a.push_back(poissonPmf(k, m.depth) / tail);
    reach.push_back(tail);
  }
  return prefixSumSecondMoment(a, reach, m.mean, m.square);
}

inline double secondMoment(const NextFlight&, const ControlledFunction& c, int cells = 20000) {
  return walkSecondMoment(
      c.line(), c.sigma(), [](double q, double t) { return 2 * q * t - q * q; }, cells);
}
inline double secondMoment(const UnidirectionalMis&, const ControlledFunction& c, int cells = 20000) {
  return walkSecondMoment(
      c.line(), c.sigma(),
      [](double q, double t) {
        const double h = q / (1 + q);
        return h * h * (1 + 3 * q) + 2 * h * (t - q);
      },
      cells);
}

/// P-series cumulative in a constant medium, where every null ratio is `ratio`.
struct CumulativeInConstant {
  double mean = 0, variance = 0, lookups = 0;
  double largest = 0;  ///< term, for the rounding of the sums

  CumulativeInConstant(double depth, double ratio) {
    double weight = 1, sum = 1, reach = 1, second = 0;
    const double scale = std::exp(-depth);
    for (double k = 1; reach > 1e-30; ++k) {
      lookups += reach;
      weight *= depth * ratio / k;
      const double go = std::min(std::abs(weight), 1.0), end = reach * (1 - go);
      mean += end * scale * sum;
      second += end * scale * scale * sum * sum;
      reach *= go;
      if (!(go > 0)) break;
      weight /= go;
      sum += weight;
      largest = std::max(largest, scale * std::abs(weight));
    }
    variance = second - mean * mean;
  }
};

}  // namespace pbrtmedia::test
