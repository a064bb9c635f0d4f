// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "transmittance/parts/falling_inverse.h"

namespace pbrtmedia {

/// g = w exp(-a F) + (1 - w) exp(-b F): two kinds of cells, or two groups of wavelengths. F: >= 0, infinity
/// included, where a part with factor 0 stays.
struct MixtureLaw {
  static constexpr std::string_view kName = "mixture";
  static constexpr std::string_view kFormula = "w exp(-a F) + (1 - w) exp(-b F)";
  double weight = 0.5;  ///< w in [0, 1]
  double thin = 0.5;    ///< a >= 0
  double thick = 1.5;   ///< b >= 0

  static constexpr auto parameters() {
    return std::tuple{
        Parameter{"weight", &MixtureLaw::weight, "share w of the first part", 0, 1},
        Parameter{"thin", &MixtureLaw::thin, "factor a on the depth of the first part", 0, 1e6},
        Parameter{"thick", &MixtureLaw::thick, "factor b on the depth of the second part", 0, 1e6}};
  }
  double operator()(double depth) const {
    const auto part = [&](double factor) { return factor > 0 ? std::exp(-factor * depth) : 1; };
    return weight * part(thin) + (1 - weight) * part(thick);
  }
  double density(double depth) const {
    const auto part = [&](double factor) { return factor > 0 ? factor * std::exp(-factor * depth) : 0; };
    return weight * part(thin) + (1 - weight) * part(thick);
  }
  double depthReached(double u) const { return invertFalling(*this, u); }
};

}  // namespace pbrtmedia
