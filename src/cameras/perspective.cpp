// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/perspective.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "base/warp.h"
#include "cameras/camera_checks.h"

namespace pbrtmedia {
namespace {

double tanOfHalf(float fov) {
  if (!(fov > 0 && fov < 180)) {
    throw std::invalid_argument("fov must lie in (0, 180) degrees, found " + std::to_string(fov));
  }
  return std::tan(radians(double{fov}) / 2);
}

}  // namespace

PerspectiveCamera::PerspectiveCamera(const AnimatedTransform& worldFromCamera, const Params& params)
    : Camera(worldFromCamera, params.shutterOpen, params.shutterClose),
      screen_(params.fullResolution, params.screenWindow),
      tanHalfFov_(tanOfHalf(params.fov)),
      lensRadius_(params.lensRadius),
      inverseFocalDistance_(checkedInverseFocalDistance(params.lensRadius, params.focalDistance)) {
  requireInvertible(worldFromCamera);
  requireShutter(params.shutterOpen, params.shutterClose);
  fixed_ = place(worldFromCamera.start());
}

PerspectiveCamera::Placed PerspectiveCamera::place(const Transform& worldFromCamera) const {
  const Point2d corner = screen_(0, 0);
  return {.eye = worldFromCamera.point(Vec3d{0, 0, 0}),
          .lensX = worldFromCamera.vector(Vec3d{lensRadius_, 0, 0}),
          .lensY = worldFromCamera.vector(Vec3d{0, lensRadius_, 0}),
          .corner = worldFromCamera.vector(Vec3d{corner.x * tanHalfFov_, corner.y * tanHalfFov_, 1}),
          .right = worldFromCamera.vector(Vec3d{screen_.xPerPixel() * tanHalfFov_, 0, 0}),
          .down = worldFromCamera.vector(Vec3d{0, screen_.yPerPixel() * tanHalfFov_, 0})};
}

Camera::WeightedRay PerspectiveCamera::generateRay(Point2f film, Point2f lens, float time) const {
  const float t = rayTime(time);
  const Placed placed = worldFromCamera().isAnimated() ? place(worldFromCamera().at(t)) : fixed_;
  Vec3d direction = placed.corner + double{film.x} * placed.right + double{film.y} * placed.down;
  Vec3d origin = placed.eye;
  if (lensRadius_ > 0) {
    // From the lens point to where the pinhole ray meets the focal plane, divided by the focal distance.
    const Point2f disk = sampleConcentricDisk(lens);
    const Vec3d offset = double{disk.x} * placed.lensX + double{disk.y} * placed.lensY;
    origin += offset;
    direction -= offset * inverseFocalDistance_;
  }
  WeightedRay r;
  r.ray.o = r.ray.rxOrigin = r.ray.ryOrigin = Point3f(origin);
  r.ray.d = Vector3f(normalize(direction));
  r.ray.rxDirection = Vector3f(normalize(direction + placed.right));
  r.ray.ryDirection = Vector3f(normalize(direction + placed.down));
  r.ray.hasDifferentials = true;
  r.ray.time = t;
  return r;
}

}  // namespace pbrtmedia
