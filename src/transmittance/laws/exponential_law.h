// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <string_view>

namespace pbrtmedia {

/// g = exp(-F): positions of the particles are independent. F may be of either sign; g of infinity is 0.
struct ExponentialLaw {
  static constexpr std::string_view kName = "exponential";
  static constexpr std::string_view kFormula = "exp(-F)";
  double operator()(double depth) const { return std::exp(-depth); }
  double density(double depth) const { return std::exp(-depth); }
  double depthReached(double u) const { return -std::log(u); }
};

}  // namespace pbrtmedia
