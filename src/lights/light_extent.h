// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <numbers>

#include "base/bounds.h"
#include "base/vec.h"

namespace pbrtmedia {

/// Where the light of a source comes from and whither it goes, as far as choosing among sources needs to
/// know: an estimate, which steers noise only. World space.
///
/// Directions in which the source shines lie within `spread` of `axis`, or up to `fade` beyond, where light
/// falls off like the cosine of the angle between (Conty Estevez & Kulla 2018, doi:10.1145/3233305,
/// section 4.1).
struct LightExtent {
  Bounds3f bounds{};       ///< of the points of the source; empty: it shines from infinitely far
  Vector3f axis{0, 0, 1};  ///< unit
  float spread = std::numbers::pi_v<float>;    ///< radians, in [0, π]
  float fade = std::numbers::pi_v<float> / 2;  ///< radians, in [0, π/2]
  /// Power over this is the intensity in the directions of full strength, sr.
  float solidAngle = 4 * std::numbers::pi_v<float>;

  bool isInfinitelyFar() const { return bounds.isEmpty(); }
};

}  // namespace pbrtmedia
