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
      film_{params.fullResolution},
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
  r.ray.o = Point3f(worldFromCameraNow.point(Vec3d{0, 0, 0}));
  r.ray.d = direction(film.x, film.y);
  r.ray.time = t;
  if (!wantsDifferentials()) return r;
  r.ray.rxOrigin = r.ray.ryOrigin = r.ray.o;
  r.ray.rxDirection = direction(double{film.x} + 1, film.y);
  r.ray.ryDirection = direction(film.x, double{film.y} + 1);
  r.ray.hasDifferentials = true;
  return r;
}

Transform EnvironmentCamera::placedAt(float time) const {
  return worldFromCamera().isAnimated() ? worldFromCamera().at(time) : worldFromCamera().start();
}

Importance EnvironmentCamera::seenAlong(const Transform& worldFromCameraNow, Vec3d d) const {
  const Vec3d c = worldFromCameraNow.inverse().vector(d);
  const double across = std::hypot(c.x, c.z), size = length(c), phi = std::atan2(c.z, c.x);
  const std::optional<Point2f> film = film_.at((phi < 0 ? phi + 2 * std::numbers::pi : phi) / phiPerPixel_,
                                               std::atan2(across, c.y) / thetaPerPixel_);
  if (!film || !(across > 0)) return {};  // the poles are lines on the film
  const double inCamera = size / across / (film_.area() * thetaPerPixel_ * phiPerPixel_);
  const double cameraPerWorld =
      1 / (std::abs(worldFromCameraNow.matrix().determinant3()) * size * size * size);
  return {static_cast<float>(inCamera * cameraPerWorld), *film};
}

Importance EnvironmentCamera::we(const Ray& ray) const { return seenAlong(placedAt(ray.time), Vec3d(ray.d)); }

WePdf EnvironmentCamera::pdfWe(const Ray& ray) const {
  return {.position = 0, .direction = seenAlong(placedAt(ray.time), Vec3d(ray.d)).value};
}

WiSample EnvironmentCamera::sampleWi(Point3f reference, Point2f, float time) const {
  const Transform placed = placedAt(time);
  const Vec3d from = Vec3d(reference) - placed.point(Vec3d{0, 0, 0});
  const double distance = length(from);
  if (!(distance > 0)) return {};
  const Importance seen = seenAlong(placed, from / distance);
  if (!(seen.value > 0)) return {};
  return {.importance = static_cast<float>(double{seen.value} / sqr(distance)),
          .wi = Vector3f(-from / distance),
          .distance = static_cast<float>(distance),
          .pdf = 1,
          .film = seen.film};
}

}  // namespace pbrtmedia
