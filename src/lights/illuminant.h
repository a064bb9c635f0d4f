// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "base/vec.h"
#include "lights/light_extent.h"
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
  /// Where it is and whither it shines; nothing: unknown, or changing with time. After preparation.
  virtual std::optional<LightExtent> extent() const { return std::nullopt; }
  /// The same radiance from every direction, so that sampling a BSDF or phase function finds it best.
  virtual bool isUniformInfinite() const { return false; }
};

}  // namespace pbrtmedia
