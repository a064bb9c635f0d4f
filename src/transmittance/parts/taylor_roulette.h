// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <span>

#include "transmittance/law.h"

namespace pbrtmedia {

/// The order N that an estimate of the Taylor series of pink noise goes to, and the sum of its terms. Orders
/// below `terms` are certain, order `terms` has the probability `correction`, and the series goes on from
/// order j - 1 to j with P_acc(j) = (1 + (j - 1) C^2) / j, but no more than kMostContinuation. Misso et al.
/// 2022, Eq. (26); the limit is ours: without it the series never ends for C >= 1. It acts for C^2 > 0.87.
struct TaylorRoulette {
  static constexpr double kMostContinuation = 0.9;
  static constexpr std::uint64_t kMostTerms = 64;

  PinkNoiseLaw law;
  std::uint64_t terms = 3;
  double correction = 0.1;

  /// P_j / P_{j-1}, P_j = Pr{N >= j}, j >= 1.
  double continuation(std::uint64_t j) const {
    if (j < terms) return 1;
    return j == terms ? correction : std::min(law.growth(static_cast<double>(j)), kMostContinuation);
  }
  /// N from one uniform number in (0, 1]: the largest j with P_j >= u. Below terms + 350, as u >= 2^-53.
  std::uint64_t draw(double u) const;
  /// E[N] = P_1 + P_2 + ...
  double expectedOrder() const;

  /// out[c] = sum_{j <= N} Delta_j / P_j about the pivot alpha = sigmaT[c] * pivot, with (alpha - F)^j the
  /// elementary symmetric mean of order j of alpha - sigmaT[c] F_i; columns are F_1 .. F_N. Cost N^2.
  void sumAbout(double pivot, std::span<const double> columns, std::span<const double> sigmaT,
                std::span<double> out) const;
  /// With N + 1 columns, each in turn the pivot of the others: the mean of these. Cost N^3.
  void sumAboutEach(std::span<const double> columns, std::span<const double> sigmaT,
                    std::span<double> out) const;
};

}  // namespace pbrtmedia
