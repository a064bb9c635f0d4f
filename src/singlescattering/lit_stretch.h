// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

#include "lighting/light_selector.h"
#include "singlescattering/position_lights.h"
#include "world/media_stretch.h"

namespace pbrtmedia {

/// A stretch of a path's ray in media of the exponential law that can scatter, and the lights at points that
/// may shine on it. Borrows both.
struct LitStretch {
  MediaStretch media;
  const PositionLights& lights;
  double extinction;  ///< MediaStretch::meanExtinction, > 0
};

/// The point at `t` of a stretch.
inline Point3f pointOf(const MediaStretch& media, double t) {
  const Ray& ray = media.ray();
  return Point3f(Vec3d(ray.o) + t * Vec3d(ray.d));
}

/// The density per length with which the path's flight collides at a distance, by its control
/// (MediaStretch::flightDensity), and samples a light there. Computed when it is asked for.
class CollisionDensity {
 public:
  /// `p`: the point at `t`.
  CollisionDensity(const MediaStretch& media, const LightSelector& selector, std::size_t light, double t,
                   Point3f p)
      : media_(media), selector_(selector), light_(light), t_(t), p_(p) {}
  /// Of a collision with any phase function, as all of them share what is found.
  double operator()() const {
    LightReceiver at(p_);
    at.findsUniformLights = selector_.leavesOutUniformLights();
    return media_.flightDensity(t_) * double{selector_.probability(at, light_)};
  }

 private:
  const MediaStretch& media_;
  const LightSelector& selector_;
  std::size_t light_;
  double t_;
  Point3f p_;
};

}  // namespace pbrtmedia
