// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>

namespace pbrtmedia {

/// Which level of a sequence of ever better approximations a debiased estimate corrects: level i with
/// Pr{i} = rate (1 - rate)^i. The single-term estimate is I(0) + (I(i+1) - I(i)) / Pr{i}, and that of all
/// prefixes divides each difference up to i by Pr{level >= it}. Misso et al. 2022, Eqs. (14), (15); Rhee &
/// Glynn 2015.
class GeometricLevels {
 public:
  /// `rate`: in (0, 1).
  explicit GeometricLevels(double rate) : rate_(rate) {}

  /// From u in (0, 1].
  unsigned draw(double u) const { return static_cast<unsigned>(std::log(u) / std::log1p(-rate_)); }
  /// Pr{level >= i}.
  double reaching(unsigned i) const { return std::pow(1 - rate_, i); }
  double probability(unsigned i) const { return rate_ * reaching(i); }

 private:
  double rate_;
};

}  // namespace pbrtmedia
