// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/animated_transform.h"
#include "base/ray.h"
#include "base/vec.h"

namespace pbrtmedia {

/// Maps a film sample to a world ray. Immutable, thread-safe.
class Camera {
 public:
  virtual ~Camera() = default;
  struct WeightedRay {
    RayDifferential ray;  ///< world space, unit direction, differentials one pixel apart
    float weight = 1;
  };
  /// `film`: raster position in pixels, y down; `lens`, `time`: in [0, 1).
  virtual WeightedRay generateRay(Point2f film, Point2f lens, float time) const = 0;
  const AnimatedTransform& worldFromCamera() const { return worldFromCamera_; }

 protected:
  Camera(const AnimatedTransform& worldFromCamera, float shutterOpen, float shutterClose)
      : worldFromCamera_(worldFromCamera), shutterOpen_(shutterOpen), shutterClose_(shutterClose) {}
  float rayTime(float u) const { return (1 - u) * shutterOpen_ + u * shutterClose_; }

 private:
  AnimatedTransform worldFromCamera_;
  float shutterOpen_, shutterClose_;
};

}  // namespace pbrtmedia
