// SPDX-License-Identifier: BSD-2-Clause
#include "fields/exploration.h"

#include <algorithm>

namespace pbrtmedia {

Exploration planExploration(const LatticeShape& shape, int mostPasses, std::uint64_t mostLookups) {
  Exploration plan{.blocks = shape.count};
  const auto affordable = [&] {
    return mostLookups / Exploration::kLookupsPerPass / static_cast<std::uint64_t>(plan.blockCount());
  };
  while (affordable() == 0 && plan.blockCount() > 1) {
    plan.blockEdge *= 2;
    const auto along = [&](std::int64_t cells) { return (cells + plan.blockEdge - 1) / plan.blockEdge; };
    plan.blocks = {along(shape.count.x), along(shape.count.y), along(shape.count.z)};
  }
  plan.passes = static_cast<int>(std::min(static_cast<std::uint64_t>(std::max(mostPasses, 0)), affordable()));
  return plan;
}

}  // namespace pbrtmedia
