// SPDX-License-Identifier: BSD-2-Clause
#include "media/box_emission.h"

#include <algorithm>
#include <cmath>

namespace pbrtmedia {

std::unique_ptr<const EmissionVolume> BoxEmission::over(const Bounds3f& box, Rgb emission) {
  if (box.isEmpty()) return nullptr;
  const Vec3d size = Vec3d(box.max) - Vec3d(box.min);
  const double volume = size.x * size.y * size.z;
  if (!(volume > 0) || !std::isfinite(volume) || !std::isfinite(1 / volume)) return nullptr;
  return std::unique_ptr<const EmissionVolume>(new BoxEmission(box, volume, emission));
}

EmissionVolume::Sample BoxEmission::sample(const std::array<double, 3>& u) const {
  Point3f p;
  for (std::size_t a = 0; a < 3; ++a) {
    const double low = box_.min[a], high = box_.max[a];
    p[a] = std::clamp(static_cast<float>(low + u[a] * (high - low)), box_.min[a], box_.max[a]);
  }
  return {p, 1 / volume_};
}

}  // namespace pbrtmedia
