// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>

#include "shapes/surface_interaction.h"

namespace pbrtmedia {

/// x along shading dp/du made orthogonal to the shading normal; any x where dp/du says nothing.
inline Frame shadingFrame(const SurfaceInteraction& si) {
  const Normal3f n = si.shading.n;
  const Vector3f along = si.shading.dpdu - dot(n, si.shading.dpdu) * n;
  const float l2 = lengthSquared(along);
  if (!(l2 > 0) || !std::isfinite(l2)) return Frame::fromZ(n);
  const Vector3f s = along / std::sqrt(l2);
  return {s, cross(n, s), n};
}

}  // namespace pbrtmedia
