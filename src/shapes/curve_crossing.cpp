// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/curve_crossing.h"

#include <cmath>
#include <tuple>

namespace pbrtmedia {

RaySpace::RaySpace(Vec3d rayOrigin, Vec3d direction, Vec3d along) : origin(rayOrigin), z(direction) {
  const Vec3d across = cross(direction, along);
  const double size = length(across);
  if (size > 0 && std::isfinite(size)) {
    y = across / size;
    x = cross(y, z);
  } else {
    std::tie(x, y) = coordinateSystem(direction);
  }
}

}  // namespace pbrtmedia
