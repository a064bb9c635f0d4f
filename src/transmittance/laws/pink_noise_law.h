// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <string_view>
#include <tuple>

#include "base/parameters.h"

namespace pbrtmedia {

/// g = (1 + C^2 F)^(-1/C^2): density fluctuations with a 1/f spectrum. The mean of exp(-gamma F) over gamma ~
/// Gamma(shape 1/C^2, scale C^2). Misso et al. 2022, doi:10.1145/3528223.3530160, Eq. (24).
///
/// F: >= 0, infinity included, where g is 0. Relative error a few roundings of -log g.
struct PinkNoiseLaw {
  static constexpr std::string_view kName = "pinknoise";
  static constexpr std::string_view kFormula = "(1 + C^2 F)^(-1/C^2)";
  double correlation = 0.5;  ///< C >= 0; 0: the exponential law

  static constexpr auto parameters() {
    return std::tuple{Parameter{"correlation", &PinkNoiseLaw::correlation,
                                "strength C of the density fluctuations; 0: the exponential law", 0, 1e3}};
  }
  double operator()(double depth) const { return std::exp(logarithm(depth)); }
  /// log g(depth), finite for every finite depth.
  double logarithm(double depth) const {
    const double c2 = correlation * correlation, y = c2 * depth;
    if (!(y > 0)) return -depth;
    // log1p(y) / y keeps its digits where c2 and y are tiny; where y overflows, 1 + y = y.
    if (!std::isinf(y)) return -depth * (std::log1p(y) / y);
    return -(std::log(depth) + 2 * std::log(correlation)) / c2;
  }
  double density(double depth) const {
    const double c2 = correlation * correlation, y = c2 * depth;
    if (!(y > 0)) return std::exp(-depth);
    return std::isinf(y) ? 0 : std::exp(logarithm(depth)) / (1 + y);
  }
  double depthReached(double u) const { return depthOfExponent(-std::log(u)); }
  /// The F at which -log g reaches `exponent` >= 0; infinite where no double does.
  double depthOfExponent(double exponent) const {
    const double y = correlation * correlation * exponent;
    return y > 0 ? exponent * (std::expm1(y) / y) : exponent;
  }

  /// Taylor coefficients c_k = g^(k)(depth) / k! follow from c_0 = g(depth) by
  ///   c_k / c_{k-1} = -growth(k) / (1 + C^2 depth),  k = 1, 2, ...
  double taylorRatio(double depth, double k) const {
    return -growth(k) / (1 + correlation * correlation * depth);
  }
  /// (1 + (k - 1) C^2) / k: 1 for k = 1, then towards C^2.
  double growth(double k) const {
    const double c2 = correlation * correlation;
    return c2 + (1 - c2) / k;
  }
};

}  // namespace pbrtmedia
