// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "base/vec.h"

// What the cameras find their importance with.

namespace pbrtmedia {

/// The whole film, whatever the crop.
struct FullFilm {
  Point2i resolution;

  /// Pixels.
  double area() const { return double(resolution.x) * resolution.y; }
  /// The raster position; nothing when it is not on the film.
  std::optional<Point2f> at(double x, double y) const {
    const Point2f p{static_cast<float>(x), static_cast<float>(y)};
    if (!(x >= 0 && y >= 0 && p.x < static_cast<float>(resolution.x) &&
          p.y < static_cast<float>(resolution.y))) {
      return std::nullopt;
    }
    return p;
  }
};

/// The coefficients of x a + y b + z c = v; nothing when the three vectors lie in a plane.
inline std::optional<Vec3d> coefficients(Vec3d a, Vec3d b, Vec3d c, Vec3d v) {
  const double volume = dot(a, cross(b, c));
  if (volume == 0) return std::nullopt;
  return Vec3d{dot(v, cross(b, c)), dot(a, cross(v, c)), dot(a, cross(b, v))} / volume;
}

}  // namespace pbrtmedia
