// SPDX-License-Identifier: BSD-2-Clause
#include "media/emission/box_emission.h"

#include <algorithm>
#include <cmath>

namespace pbrtmedia {

std::unique_ptr<const EmissionVolume> BoxEmission::over(const Bounds3f& box, Rgb emission, Rgb sigmaT) {
  if (box.isEmpty()) return nullptr;
  const Vec3d size = Vec3d(box.max) - Vec3d(box.min);
  const double volume = size.x * size.y * size.z;
  if (!(volume > 0) || !std::isfinite(volume) || !std::isfinite(1 / volume)) return nullptr;
  // Of a convex body the mean chord is four times its volume over its surface.
  const double surface = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
  const double chord = 4 * volume / surface;
  Rgb total;
  for (std::size_t c = 0; c < 3; ++c) {
    const double escaping = escapingShare(static_cast<double>(sigmaT[c]) * chord);
    total[c] = static_cast<float>(static_cast<double>(emission[c]) * volume * escaping);
  }
  return std::unique_ptr<const EmissionVolume>(new BoxEmission(box, volume, total));
}

Point3f BoxEmission::sample(const std::array<double, 3>& u) const {
  Point3f p;
  for (std::size_t a = 0; a < 3; ++a) {
    const double low = box_.min[a], high = box_.max[a];
    p[a] = std::clamp(static_cast<float>(low + u[a] * (high - low)), box_.min[a], box_.max[a]);
  }
  return p;
}

double BoxEmission::density(Point3f p) const {
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(p[a] >= box_.min[a] && p[a] <= box_.max[a])) return 0;
  }
  return 1 / volume_;
}

double BoxEmission::directionDensity(const Segment& line) const {
  const auto span = clipToBox(Bounds3d{Vec3d(box_.min), Vec3d(box_.max)}, Vec3d(line.o), Vec3d(line.d),
                              line.tMin, line.tMax);
  return span ? squaresOver(span->tMin, span->tMax) / volume_ : 0;
}

}  // namespace pbrtmedia
