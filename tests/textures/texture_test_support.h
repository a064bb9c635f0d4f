// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "shapes/surface_interaction.h"

namespace pbrtmedia::test {

/// A point with the given texture coordinates and no footprint.
inline SurfaceInteraction atUv(float u, float v) {
  SurfaceInteraction si;
  si.uv = {u, v};
  return si;
}

/// A point in world space with no footprint.
inline SurfaceInteraction atPoint(Point3f p) {
  SurfaceInteraction si;
  si.p = p;
  return si;
}

}  // namespace pbrtmedia::test
