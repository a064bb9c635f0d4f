// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

#include "base/vec.h"

namespace pbrtmedia {

/// Picks one light of the scene's table for a point (scene-language reference 11.3). Immutable after
/// construction as far as results are concerned, thread-safe. Never asked when the scene has no lights.
class LightSelector {
 public:
  virtual ~LightSelector() = default;
  struct Choice {
    std::size_t light;  ///< index into Scene::illuminants()
    float probability;  ///< > 0
  };
  /// `p`: world; `u`: in [0, 1).
  virtual Choice choose(Point3f p, float u) const = 0;
  /// Probability that `choose(p, .)` picks the light.
  virtual float probability(Point3f p, std::size_t light) const = 0;
};

}  // namespace pbrtmedia
