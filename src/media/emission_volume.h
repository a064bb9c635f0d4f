// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>

#include "base/bounds.h"
#include "base/vec.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// Where a medium emits, as light sampling sees it: points with an explicit density over a volume, positive
/// wherever the medium emits within `bounds`. In the world space of the medium's definition. Immutable,
/// thread-safe.
class EmissionVolume {
 public:
  virtual ~EmissionVolume() = default;
  struct Sample {
    Point3f p;
    double pdf;  ///< per volume, > 0
  };
  /// `u` in [0, 1) each.
  virtual Sample sample(const std::array<double, 3>& u) const = 0;
  /// 0 outside `bounds`.
  virtual double pdf(Point3f p) const = 0;
  virtual Bounds3f bounds() const = 0;
  /// Estimate of the integral of sigma_a Le over the volume: steers the selection of lights.
  virtual Rgb total() const = 0;
};

}  // namespace pbrtmedia
