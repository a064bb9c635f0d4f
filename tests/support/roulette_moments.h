// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pbrtmedia::test {

/// Exact moments of a power series about a fixed pivot, each factor an independent Y of mean m and variance
/// s^2. Only these two matter, whatever the medium. Orders up to `most` are counted. A roulette tells
/// continuation(k) = P_k / P_{k-1} and termFactor(k) = a_k / a_{k-1}, a_k what term k weighs: 1 / (k! P_k)
/// for the series of exp.
class RouletteMoments {
 public:
  template <class Roulette>
  explicit RouletteMoments(const Roulette& roulette, std::size_t most = 90)
      : reached_(most + 2), weight_(most + 1), logFactorial_(most + 2) {
    reached_[0] = weight_[0] = 1;
    for (std::size_t k = 1; k <= most + 1; ++k) {
      reached_[k] = reached_[k - 1] * roulette.continuation(k);
      logFactorial_[k] = logFactorial_[k - 1] + std::log(static_cast<double>(k));
      if (k <= most) weight_[k] = weight_[k - 1] * roulette.termFactor(k);
    }
  }

  /// E[(sum_k a_k Y_1 .. Y_k)^2]: plain products. Without the square of the value at the pivot.
  double productSecondMoment(double m, double variance) const {
    double sum = 0;
    for (std::size_t j = 0; j < weight_.size(); ++j) {
      for (std::size_t k = 0; k < weight_.size(); ++k) {
        const std::size_t low = std::min(j, k), high = std::max(j, k);
        sum += weight_[j] * weight_[k] * reached_[high] * power(variance + m * m, low) * power(m, high - low);
      }
    }
    return sum;
  }
  /// The same for elementary symmetric means, by the overlap of two random choices out of N.
  double symmetricSecondMoment(double m, double variance) const {
    double sum = 0;
    for (std::size_t n = 0; n < weight_.size(); ++n) {
      const double share = reached_[n] - reached_[n + 1];
      if (!(share > 0)) continue;
      double given = 0;
      for (std::size_t j = 0; j <= n; ++j) {
        for (std::size_t k = 0; k <= n; ++k) {
          given += weight_[j] * weight_[k] * meanProduct(n, j, k, m, variance);
        }
      }
      sum += share * given;
    }
    return sum;
  }

  /// E[m_j m_k] of n independent Y.
  double meanProduct(std::size_t n, std::size_t j, std::size_t k, double m, double variance) const {
    double sum = 0;
    for (std::size_t r = j + k > n ? j + k - n : 0; r <= std::min(j, k); ++r) {
      const double overlap = std::exp(logChoose(j, r) + logChoose(n - j, k - r) - logChoose(n, k));
      sum += overlap * power(variance + m * m, r) * power(m, j + k - 2 * r);
    }
    return sum;
  }

 private:
  static double power(double x, std::size_t n) { return std::pow(x, static_cast<double>(n)); }
  double logChoose(std::size_t n, std::size_t k) const {
    return logFactorial_[n] - logFactorial_[k] - logFactorial_[n - k];
  }

  std::vector<double> reached_, weight_;  ///< P_k and a_k
  std::vector<double> logFactorial_;
};

}  // namespace pbrtmedia::test
