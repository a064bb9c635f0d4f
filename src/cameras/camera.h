// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/animated_transform.h"
#include "base/ray.h"
#include "base/vec.h"

namespace pbrtmedia {

/// How much a camera makes of radiance along a ray that leaves it.
struct Importance {
  /// Share of the film that sees it, per solid angle and area across the ray; only per solid angle, or per
  /// area, where the camera sees from one point or along one direction. 0: it is not seen.
  float value = 0;
  Point2f film;  ///< raster position at which it is seen, pixels, on the full film
};

/// Densities of the rays of a camera for film positions uniform over the full film. 0 for what is no choice:
/// a camera that sees from one point, or along one direction.
struct WePdf {
  float position = 0;   ///< 1/area: on a thin lens; across the ray for orthographic cameras
  float direction = 0;  ///< 1/solid angle
};

/// A direction toward a camera from a reference point, as LightSample is toward a light: radiance L that
/// leaves the point along it adds importance · L · |cos| / pdf at the raster position, of a film whose pixels
/// each have the share 1 / (width height).
struct WiSample {
  float importance = 0;  ///< arriving along -wi, before visibility and transmittance
  Vector3f wi;           ///< unit, from the reference point to the camera
  float distance = 0;    ///< world length to the camera
  float pdf = 0;  ///< solid angle; 1 where the direction is no choice; 0: the film does not see the point
  Point2f film;   ///< raster position, pixels
};

/// Maps a film sample to a world ray, and rays and points back to the film. Immutable, thread-safe.
///
/// Importance integrates to 1 over the full film, as all rays have the weight 1; what is beyond the film and
/// within the reach of its filter is not seen by it. PBRT-v3 knows the importance of perspective cameras
/// only. Cameras that weigh their rays have none (`hasImportance`).
class Camera {
 public:
  virtual ~Camera() = default;
  struct WeightedRay {
    RayDifferential ray;  ///< world space, unit direction, differentials one pixel apart or none
    float weight = 1;
  };
  /// `film`: raster position in pixels, y down; `lens`, `time`: in [0, 1).
  virtual WeightedRay generateRay(Point2f film, Point2f lens, float time) const = 0;
  /// Whether `we`, `pdfWe` and `sampleWi` know anything.
  virtual bool hasImportance() const { return true; }
  /// Of a ray with unit direction that starts on the camera, at `ray.time`. Black for cameras that do not
  /// know theirs: the scene is then found by rays from the camera alone.
  virtual Importance we(const Ray& ray) const {
    (void)ray;
    return {};
  }
  virtual WePdf pdfWe(const Ray& ray) const {
    (void)ray;
    return {};
  }
  /// `lens`: uniform in the unit square; `time`: of rays, as in Ray.
  virtual WiSample sampleWi(Point3f reference, Point2f lens, float time) const {
    (void)reference, (void)lens, (void)time;
    return {};
  }
  const AnimatedTransform& worldFromCamera() const { return worldFromCamera_; }
  /// Rays have no differentials from now on: nobody asks for the footprint of a pixel. Not while rays are
  /// generated.
  void leaveOutDifferentials() { wantsDifferentials_ = false; }

 protected:
  Camera(const AnimatedTransform& worldFromCamera, float shutterOpen, float shutterClose)
      : worldFromCamera_(worldFromCamera), shutterOpen_(shutterOpen), shutterClose_(shutterClose) {}
  float rayTime(float u) const { return (1 - u) * shutterOpen_ + u * shutterClose_; }
  bool wantsDifferentials() const { return wantsDifferentials_; }

 private:
  AnimatedTransform worldFromCamera_;
  float shutterOpen_, shutterClose_;
  bool wantsDifferentials_ = true;
};

}  // namespace pbrtmedia
