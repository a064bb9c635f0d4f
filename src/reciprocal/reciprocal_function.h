// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>

namespace pbrtmedia {

/// g(F) = 1/F with its Taylor series about alpha: c_0 = 1/alpha, c_j / c_{j-1} = -1/alpha, so 1/F = sum_j
/// (alpha - F)^j / alpha^(j+1) for 0 < F < 2 alpha. Misso et al. 2022, doi:10.1145/3528223.3530160, Eq. (6);
/// Booth 2007. Its coefficients do not fall: how far an estimate goes is for a roulette to say. F, alpha: >
/// 0.
struct ReciprocalFunction {
  double operator()(double integral) const { return 1 / integral; }
  double logarithm(double alpha) const { return -std::log(alpha); }
  double taylorRatio(double alpha, double) const { return -1 / alpha; }
  double growth(double) const { return 1; }
};

}  // namespace pbrtmedia
