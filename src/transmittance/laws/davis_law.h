// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <limits>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "transmittance/laws/pink_noise_law.h"

namespace pbrtmedia {

/// g = (1 + F^beta C^(1+beta))^(-F^(1-beta) / C^(1+beta)): density fluctuations whose spectrum falls like
/// f^-beta. beta = 1 is pink noise, C = 0 the exponential law. Davis & Mineev-Weinstein 2011,
/// https://doi.org/10/gfxnc4; Misso et al. 2022, Eq. (23).
///
/// F: >= 0, infinity included, where g is 0. Relative error a few roundings of -log g.
struct DavisLaw {
  static constexpr std::string_view kName = "davis";
  static constexpr std::string_view kFormula = "(1 + F^beta C^(1+beta))^(-F^(1-beta) / C^(1+beta))";
  double correlation = 0.5;  ///< C >= 0; 0: the exponential law
  double beta = 1;           ///< exponent of the power spectrum, in [0, 1]

  static constexpr auto parameters() {
    return std::tuple{
        Parameter{"correlation", &DavisLaw::correlation,
                  "strength C of the density fluctuations; 0: the exponential law", 0, 1e3},
        Parameter{"beta", &DavisLaw::beta, "exponent of the power spectrum: 0 white, 1 pink", 0, 1}};
  }
  double operator()(double depth) const {
    if (!(depth > 0)) return 1;
    const double y = std::pow(depth, beta) * std::pow(correlation, 1 + beta);
    if (!(y > 0)) return std::exp(-depth);
    // g = exp(-F log1p(y) / y), safe for F and C towards 0; where y overflows, 1 + y = y.
    if (!std::isinf(y)) return std::exp(-depth * (std::log1p(y) / y));
    const double logY = beta * std::log(depth) + (1 + beta) * std::log(correlation);
    return std::exp(-logY * std::pow(depth, 1 - beta) * std::pow(correlation, -1 - beta));
  }
  /// g = exp(-h) with h' = (1 - beta) log1p(y) / y + beta / (1 + y), y = F^beta C^(1+beta).
  double density(double depth) const {
    const double g = (*this)(depth);
    if (!(g > 0)) return 0;
    const double y = std::pow(depth, beta) * std::pow(correlation, 1 + beta);
    if (std::isinf(y)) return 0;
    return g * ((1 - beta) * (y > 0 ? std::log1p(y) / y : 1) + beta / (1 + y));
  }
  double depthReached(double u) const { return depthOfExponent(-std::log(u)); }

  /// The F at which -log g reaches `exponent` >= 0; infinite where no double does. Relative error some
  /// roundings of log F. Newton's method for log(-log g) over log F, which is concave with slopes in [1 -
  /// beta, 1]: from the left, where -log g <= F puts the start, it comes near without ever passing.
  double depthOfExponent(double exponent) const {
    constexpr double kMostLog = 709.7;  // of a double
    if (!(exponent > 0)) return 0;
    if (beta == 1) return PinkNoiseLaw{correlation}.depthOfExponent(exponent);
    const double logK = (1 + beta) * std::log(correlation), target = std::log(exponent);
    double z = target;
    for (int step = 0; step < kMostSteps; ++step) {
      const double y = std::exp(beta * z + logK), log1pY = std::log1p(y);
      // Where y is too small for its logarithm, log1p(y) / y = 1; where it is too large, log1p(y) = log y.
      const double logRatio = !(y > 0)        ? 0
                              : std::isinf(y) ? std::log(beta * z + logK) - (beta * z + logK)
                                              : std::log(log1pY / y);
      const double slope = 1 - beta + (y > 0 ? beta / ((1 / y + 1) * log1pY) : beta);
      const double move = (target - (z + logRatio)) / slope;
      z += move;
      if (z > kMostLog) return std::numeric_limits<double>::infinity();
      if (!(std::abs(move) > 1e-15 * (1 + std::abs(z)))) break;
    }
    return std::exp(z);
  }

 private:
  static constexpr int kMostSteps = 200;
};

}  // namespace pbrtmedia
