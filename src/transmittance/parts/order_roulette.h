// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

namespace pbrtmedia {

/// The number N of terms of the power series of exp that an estimate goes to, and what its terms weigh. P_k =
/// Pr{N >= k}; term k weighs 1 / (k! P_k). All forms share one shape: from order 0 the series goes on with
/// `beyondZero`, then surely up to order `certain`, then from k - 1 to k with min(1, expansion / k).
/// Kettunen et al. 2021, sections 2.5.2 and 4.5; Georgiev et al. 2019, Eq. (31).
struct OrderRoulette {
  std::uint64_t certain = 0;  ///< K
  double expansion = 1;       ///< c >= 0; 0: the series ends at `certain`, truncated and biased
  double beyondZero = 1;      ///< 1 - p_Z, in (0, 1]

  /// Bhanot-Kennedy: K = floor(c).
  static OrderRoulette bhanotKennedy(double c);
  /// The same, ended at order 0 with probability `zeroOrder` in [0, 1).
  static OrderRoulette aggressive(double c, double zeroOrder);
  /// p-series CMF: orders are certain while Pr{Poisson(depth) <= k - 2} < 0.99, as in all published images
  /// (Eq. (31) as printed has one less), then depth / k. depth >= 0.
  static OrderRoulette cmf(double depth);
  /// Always the first floor(c) orders and no more: a truncated series.
  static OrderRoulette truncated(double c);

  /// P_k / P_{k-1}, k >= 1.
  double continuation(std::uint64_t k) const {
    const double later = k <= certain                         ? 1
                         : expansion < static_cast<double>(k) ? expansion / static_cast<double>(k)
                                                              : 1;
    return k == 1 ? beyondZero * later : later;
  }
  /// What term k has more than term k - 1 apart from the factor y: P_{k-1} / (k P_k). Infinite where P_k is
  /// 0.
  double termFactor(std::uint64_t k) const { return 1 / (static_cast<double>(k) * continuation(k)); }

  /// N from one uniform number in (0, 1]: the largest k with P_k >= u.
  std::uint64_t draw(double u) const;
  /// E[N] = P_1 + P_2 + ...
  double expectedOrder() const;
};

}  // namespace pbrtmedia
