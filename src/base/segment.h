// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/vec.h"

namespace pbrtmedia {

/// The part tMin <= t <= tMax of the line o + t d. t is a world-space length even when d is not a unit vector
/// (a placed medium sees the segment in its own space, where d carries the placement's scale): coefficients
/// are per unit of t. Integrators pass finite segments or tMax = infinity; media clip them to their bounds.
struct Segment {
  Point3f o;
  Vector3f d;
  double tMin = 0, tMax = 0;

  double length() const { return tMax - tMin; }
  Point3f at(double t) const {
    return {static_cast<float>(o.x + t * d.x), static_cast<float>(o.y + t * d.y),
            static_cast<float>(o.z + t * d.z)};
  }
};

}  // namespace pbrtmedia
