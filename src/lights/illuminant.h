// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/vec.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// A source of light as those see it who choose one among several (LightSelector): a Light, or a medium that
/// emits. World space; immutable after preparation, thread-safe.
class Illuminant {
 public:
  virtual ~Illuminant() = default;
  /// Total emitted power estimate for light selection (scene-language reference 16.9), in W if L is in W/(m²
  /// sr).
  virtual Rgb power() const = 0;
  /// Luminance that arrives at a point, were nothing in the way, over all directions: an estimate by one
  /// sample, `u` in [0, 1)².
  virtual double arrivingLuminance(Point3f reference, Point2f u) const = 0;
};

}  // namespace pbrtmedia
