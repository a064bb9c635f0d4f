// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/interruption.h"
#include "transmittance/laws/pink_noise_law.h"
#include "transmittance/parts/scaled_double.h"
#include "transmittance/parts/symmetric_means.h"

namespace pbrtmedia {

/// The order N that an estimate of a Taylor series goes to, and the sum of its terms: g(F) = sum_j c_j(alpha)
/// (F
/// - alpha)^j about a pivot alpha, each power a product of independent estimates of F. Orders below `terms`
/// are certain, order `terms` has the probability `correction`, and the series goes on from order j - 1 to j
/// with min(growth(j), mostContinuation). Misso et al. 2022, Eqs. (4), (26); the limit is ours: without it a
/// series whose coefficients do not fall never ends. For pink noise it acts for C^2 > 0.87.
///
/// Function: logarithm(alpha) = log g(alpha), growth(j) >= 0, and taylorRatio(alpha, j) = c_j / c_{j-1}.
template <class Function>
struct TaylorRouletteOf {
  static constexpr double kMostContinuation = 0.9;
  static constexpr std::uint64_t kMostTerms = 64;
  static constexpr std::string_view kSymmetrisationHelp =
      "average products over all choices of marches, and over the march that is a sampled pivot; false: the "
      "plain series";

  Function function;
  std::uint64_t terms = 3;
  double correction = 0.1;
  bool isSymmetrised = true;
  double mostContinuation = kMostContinuation;

  /// P_j / P_{j-1}, P_j = Pr{N >= j}, j >= 1.
  double continuation(std::uint64_t j) const {
    if (j < terms) return 1;
    return j == terms ? correction : std::min(function.growth(static_cast<double>(j)), mostContinuation);
  }
  /// N from one uniform number in (0, 1]: the largest j with P_j >= u. Below terms + 37 /
  /// -log(mostContinuation), as u >= 2^-53.
  std::uint64_t draw(double u) const {
    std::uint64_t order = 0;
    for (double reaching = continuation(1); reaching >= u; reaching *= continuation(order + 1)) {
      leaveIfAbandoned();
      ++order;
    }
    return order;
  }
  /// E[N] = P_1 + P_2 + ...
  double expectedOrder() const {
    double sum = 0, reaching = 1;
    for (std::uint64_t j = 1; reaching > 1e-17; ++j) {
      leaveIfAbandoned();
      sum += reaching *= continuation(j);
    }
    return sum;
  }

  /// out[c] = sum_{j <= N} c_j (F - alpha)^j / P_j about the pivot alpha = sigmaT[c] * pivot, with (alpha -
  /// F)^j the elementary symmetric mean of order j of alpha - sigmaT[c] F_i, or the product of the first j of
  /// them; columns are F_1 .. F_N. Cost N^2, or N.
  void sumAbout(double pivot, std::span<const double> columns, std::span<const double> sigmaT,
                std::span<double> out) const {
    std::vector<double> differences, powers(columns.size() + 1);
    differences.reserve(columns.size());
    for (const double column : columns) differences.push_back(pivot - column);
    const double scale =
        isSymmetrised ? elementarySymmetricMeans(differences, powers) : leadingProducts(differences, powers);
    for (std::size_t c = 0; c < sigmaT.size(); ++c) {
      const double alpha = sigmaT[c] * pivot;
      ScaledDouble weight = ScaledDouble::exp(function.logarithm(alpha)), sum = weight;
      for (std::uint64_t j = 1; j <= columns.size(); ++j) {
        // What term j has more than term j - 1 without the powers, which do not depend on sigma; the sign of
        // alpha - F is theirs.
        weight *=
            -function.taylorRatio(alpha, static_cast<double>(j)) / continuation(j) * (sigmaT[c] * scale);
        sum += weight * powers[j];
      }
      out[c] = sum.value();
    }
  }
  /// With N + 1 columns: each in turn the pivot of the others, the mean of these, at a cost of N^3; or the
  /// first the pivot of the others.
  void sumAboutEach(std::span<const double> columns, std::span<const double> sigmaT,
                    std::span<double> out) const {
    std::vector<double> others(columns.begin() + 1, columns.end()), one(out.size());
    const std::size_t pivots = isSymmetrised ? columns.size() : 1;
    const double share = 1 / static_cast<double>(pivots);
    for (double& sum : out) sum = 0;
    for (std::size_t i = 0; i < pivots; ++i) {
      sumAbout(columns[i], others, sigmaT, one);
      for (std::size_t c = 0; c < out.size(); ++c) out[c] += one[c] * share;
      if (i < others.size()) others[i] = columns[i];  // the next pivot leaves, this one comes in
    }
  }
};

extern template struct TaylorRouletteOf<PinkNoiseLaw>;
/// Of pink noise: P_acc(j) = (1 + (j - 1) C^2) / j, Eq. (26).
using TaylorRoulette = TaylorRouletteOf<PinkNoiseLaw>;

}  // namespace pbrtmedia
