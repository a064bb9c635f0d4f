// SPDX-License-Identifier: BSD-2-Clause
#include "singlescattering/explore.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace pbrtmedia {

bool isExplorable(const MediaStretch& stretch) {
  return !stretch.state().isVacuum() && stretch.state().isExponential() && stretch.tMin() < stretch.tMax() &&
         stretch.tMax() < double{kInfinity};
}

void explore(const MediaStretch& stretch, std::size_t count, double offset, RenderCounters& counters,
             std::vector<Explorer>& explorers) {
  const std::size_t first = explorers.size();
  const double step = (stretch.tMax() - stretch.tMin()) / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double t = std::min(stretch.tMin() + (static_cast<double>(i) + offset) * step, stretch.tMax());
    explorers.push_back({t, stretch.coefficients(t, counters).sigmaT, 0});
  }
  for (std::size_t i = first + 1; i + 1 < explorers.size(); ++i) {
    const Rgb middle = (explorers[i - 1].extinction + explorers[i + 1].extinction) * 0.5f;
    for (std::size_t c = 0; c < 3; ++c) {
      explorers[i].difference =
          std::max(explorers[i].difference, double{std::abs(explorers[i].extinction[c] - middle[c])});
    }
  }
}

}  // namespace pbrtmedia
