// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/environment.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "cameras/camera_checks.h"

namespace pbrtmedia {

EnvironmentCamera::EnvironmentCamera(const AnimatedTransform& worldFromCamera, const Params& params)
    : Camera(worldFromCamera, params.shutterOpen, params.shutterClose),
      thetaPerPixel_(std::numbers::pi / params.fullResolution.y),
      phiPerPixel_(2 * std::numbers::pi / params.fullResolution.x) {
  const Point2i n = params.fullResolution;
  if (n.x <= 0 || n.y <= 0) {
    throw std::invalid_argument("film resolution must be positive, found " + std::to_string(n.x) + " x " +
                                std::to_string(n.y));
  }
  requireInvertible(worldFromCamera);
  requireShutter(params.shutterOpen, params.shutterClose);
}

Camera::WeightedRay EnvironmentCamera::generateRay(Point2f film, Point2f /*lens*/, float time) const {
  const float t = rayTime(time);
  const Transform& start = worldFromCamera().start();
  const bool animated = worldFromCamera().isAnimated();
  const Transform moved = animated ? worldFromCamera().at(t) : Transform();
  const Transform& worldFromCameraNow = animated ? moved : start;
  const auto direction = [&](double x, double y) {
    const double theta = y * thetaPerPixel_, phi = x * phiPerPixel_, sinTheta = std::sin(theta);
    const Vec3d camera{sinTheta * std::cos(phi), std::cos(theta), sinTheta * std::sin(phi)};
    return Vector3f(normalize(worldFromCameraNow.vector(camera)));
  };
  WeightedRay r;
  r.ray.o = r.ray.rxOrigin = r.ray.ryOrigin = Point3f(worldFromCameraNow.point(Vec3d{0, 0, 0}));
  r.ray.d = direction(film.x, film.y);
  r.ray.rxDirection = direction(double{film.x} + 1, film.y);
  r.ray.ryDirection = direction(film.x, double{film.y} + 1);
  r.ray.hasDifferentials = true;
  r.ray.time = t;
  return r;
}

}  // namespace pbrtmedia
