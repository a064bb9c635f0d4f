// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/orthographic.h"

#include "base/warp.h"
#include "cameras/camera_checks.h"

namespace pbrtmedia {

OrthographicCamera::OrthographicCamera(const AnimatedTransform& worldFromCamera, const Params& params)
    : Camera(worldFromCamera, params.shutterOpen, params.shutterClose),
      screen_(params.fullResolution, params.screenWindow),
      lensRadius_(params.lensRadius),
      inverseFocalDistance_(checkedInverseFocalDistance(params.lensRadius, params.focalDistance)) {
  requireInvertible(worldFromCamera);
  requireShutter(params.shutterOpen, params.shutterClose);
  fixed_ = place(worldFromCamera.start());
}

OrthographicCamera::Placed OrthographicCamera::place(const Transform& worldFromCamera) const {
  const Point2d corner = screen_(0, 0);
  return {.corner = worldFromCamera.point(Vec3d{corner.x, corner.y, 0}),
          .right = worldFromCamera.vector(Vec3d{screen_.xPerPixel(), 0, 0}),
          .down = worldFromCamera.vector(Vec3d{0, screen_.yPerPixel(), 0}),
          .lensX = worldFromCamera.vector(Vec3d{lensRadius_, 0, 0}),
          .lensY = worldFromCamera.vector(Vec3d{0, lensRadius_, 0}),
          .forward = worldFromCamera.vector(Vec3d{0, 0, 1})};
}

Camera::WeightedRay OrthographicCamera::generateRay(Point2f film, Point2f lens, float time) const {
  const float t = rayTime(time);
  const Placed placed = worldFromCamera().isAnimated() ? place(worldFromCamera().at(t)) : fixed_;
  Vec3d origin = placed.corner + double{film.x} * placed.right + double{film.y} * placed.down;
  Vec3d direction = placed.forward;
  if (lensRadius_ > 0) {
    const Point2f disk = sampleConcentricDisk(lens);
    const Vec3d offset = double{disk.x} * placed.lensX + double{disk.y} * placed.lensY;
    origin += offset;
    direction -= offset * inverseFocalDistance_;
  }
  WeightedRay r;
  r.ray.o = Point3f(origin);
  r.ray.rxOrigin = Point3f(origin + placed.right);
  r.ray.ryOrigin = Point3f(origin + placed.down);
  r.ray.d = r.ray.rxDirection = r.ray.ryDirection = Vector3f(normalize(direction));
  r.ray.hasDifferentials = true;
  r.ray.time = t;
  return r;
}

}  // namespace pbrtmedia
