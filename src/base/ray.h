// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/math.h"
#include "base/vec.h"

namespace pbrtmedia {

/// Half line o + t d, 0 < t < tMax, at a time of the shutter interval. World space unless a name says
/// otherwise. Camera and integrator rays have unit d, so t is a world length there.
struct Ray {
  Point3f o;
  Vector3f d;
  float tMax = kInfinity;
  float time = 0;

  Point3f at(float t) const { return o + t * d; }
};

/// A ray with the rays through the pixels to the right (x) and below (y), for texture filtering.
struct RayDifferential : Ray {
  bool hasDifferentials = false;
  Point3f rxOrigin, ryOrigin;
  Vector3f rxDirection, ryDirection;

  RayDifferential() = default;
  explicit RayDifferential(const Ray& r) : Ray(r) {}
  /// Scales the offsets of the auxiliary rays; 1/sqrt(samples per pixel) for sampler-driven integrators.
  void scaleDifferentials(float s) {
    rxOrigin = o + (rxOrigin - o) * s;
    ryOrigin = o + (ryOrigin - o) * s;
    rxDirection = d + (rxDirection - d) * s;
    ryDirection = d + (ryDirection - d) * s;
  }
};

}  // namespace pbrtmedia
