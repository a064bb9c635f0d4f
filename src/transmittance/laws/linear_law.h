// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <string_view>
#include <tuple>

#include "base/parameters.h"

namespace pbrtmedia {

/// g = max(0, 1 - F / extent): particles as regular as can be. Has a kink at F = extent. F: >= 0, infinity
/// included.
struct LinearLaw {
  static constexpr std::string_view kName = "linear";
  static constexpr std::string_view kFormula = "max(0, 1 - F / extent)";
  double extent = 1;  ///< optical depth at which all is absorbed, > 0

  static constexpr auto parameters() {
    return std::tuple{
        Parameter{"extent", &LinearLaw::extent, "optical depth at which nothing is left", 1e-6, 1e6}};
  }
  double operator()(double depth) const { return std::max(0.0, 1 - depth / extent); }
  double density(double depth) const { return depth < extent ? 1 / extent : 0; }
  double depthReached(double u) const { return (1 - u) * extent; }
};

}  // namespace pbrtmedia
