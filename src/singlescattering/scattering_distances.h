// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "singlescattering/main_part.h"

namespace pbrtmedia {

/// Distances on a stretch with the density of collisions that its main part would have, given that there is
/// one: the mean over the channels of extinction times transmittance, over 1 - that of the whole stretch. A
/// share is uniform, for what explorers have missed.
class ScatteringDistances {
 public:
  /// `mainPart` is borrowed.
  explicit ScatteringDistances(const MainPart& mainPart) : mainPart_(mainPart) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (mainPart.depth()[c] > kLeastDepth) channels_[count_++] = c;
    }
  }
  /// `u` in [0, 1).
  double sample(double u) const {
    const double tMin = mainPart_.tMin(), tMax = mainPart_.tMax();
    if (u < uniformShare()) return std::min(tMin + u / uniformShare() * (tMax - tMin), tMax);
    const double all = (u - uniformShare()) / (1 - uniformShare()) * static_cast<double>(count_);
    const std::size_t chosen = std::min(static_cast<std::size_t>(all), count_ - 1);
    const double share = std::clamp(all - static_cast<double>(chosen), 0.0, 1.0);
    const double depth = mainPart_.depth()[channels_[chosen]];
    const double reached = -std::log1p(share * std::expm1(-depth));
    return std::clamp(mainPart_.invert(channels_[chosen], std::min(reached, depth)), tMin, tMax);
  }
  /// Density with respect to t on the stretch; > 0.
  double pdf(double t) const {
    const MainPart::Value value = mainPart_.at(t);
    double sum = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t c = channels_[i];
      sum += value.extinction[c] * std::exp(-value.depth[c]) / -std::expm1(-mainPart_.depth()[c]);
    }
    return uniformShare() / mainPart_.length() +
           (count_ > 0 ? (1 - uniformShare()) * sum / static_cast<double>(count_) : 0);
  }

 private:
  static constexpr double kUniformShare = 0.1;
  static constexpr double kLeastDepth = 1e-12;  ///< below it a channel tells nothing of where it scatters
  double uniformShare() const { return count_ > 0 ? kUniformShare : 1; }

  const MainPart& mainPart_;
  std::size_t channels_[3] = {}, count_ = 0;
};

}  // namespace pbrtmedia
