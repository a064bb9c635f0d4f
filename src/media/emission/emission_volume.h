// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cmath>

#include "base/bounds.h"
#include "base/segment.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// Where a medium emits, as light sampling sees it: points chosen over a volume, which give a direction to
/// look along, with a positive density wherever the medium emits within `bounds`. In the world space of the
/// medium's definition. Immutable, thread-safe.
class EmissionVolume {
 public:
  virtual ~EmissionVolume() = default;
  /// A point of the volume; `u` in [0, 1) each.
  virtual Point3f sample(const std::array<double, 3>& u) const = 0;
  /// The density of such points, per volume of this space: positive where the medium emits within `bounds`,
  /// up to the rounding of points.
  virtual double density(Point3f p) const = 0;
  /// The density of the direction from the start of a line (t = 0) to such a point: the integral of t² times
  /// the density of points per volume of this space, over the part of the line inside.
  virtual double directionDensity(const Segment& line) const = 0;
  virtual Bounds3f bounds() const = 0;
  /// Estimate of the integral of sigma_a Le over the volume, less what the medium itself keeps back: steers
  /// the selection of lights.
  virtual Rgb total() const = 0;

 protected:
  /// The integral of t² over [tMin, tMax], without cancellation.
  static double squaresOver(double tMin, double tMax) {
    const double length = tMax - tMin;
    return length * (tMin * tMin + tMin * length + length * length / 3);
  }
};

/// Mean transmittance to the end of a way of that optical depth from where something emits on it.
inline double escapingShare(double depth) { return depth > 0 ? -std::expm1(-depth) / depth : 1; }

}  // namespace pbrtmedia
