// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/realistic.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "base/math.h"
#include "cameras/camera_checks.h"

namespace pbrtmedia {
namespace {

/// Of the diagonal: how far off the axis the rays run that tell of the thick lens, as in PBRT-v3.
constexpr double kNearAxis = 0.001;
/// Pixels between a ray and those that tell of its footprint.
constexpr double kStep = 0.05;

double checkedDiagonal(double diagonal) {
  if (!(diagonal > 0 && std::isfinite(diagonal))) {
    throw std::invalid_argument("Film \"diagonal\" must be > 0, found " + std::to_string(1000 * diagonal) +
                                " mm");
  }
  return diagonal;
}

Vec3d filmSizeOf(double diagonal, Point2i resolution) {
  const double aspect = double(resolution.y) / resolution.x, x = diagonal / std::sqrt(1 + aspect * aspect);
  return {x, aspect * x, 0};
}

}  // namespace

RealisticCamera::RealisticCamera(const AnimatedTransform& worldFromCamera, const LensSystem& lens,
                                 const Params& params)
    : Camera(worldFromCamera, params.shutterOpen, params.shutterClose),
      params_(params),
      lens_(lens.focusedAt(params.focusDistance, kNearAxis * checkedDiagonal(params.filmDiagonal))),
      filmSize_(filmSizeOf(params.filmDiagonal, params.fullResolution)),
      pupil_(lens_, params.filmDiagonal / 2) {
  requireInvertible(worldFromCamera);
  requireShutter(params.shutterOpen, params.shutterClose);
}

std::optional<RealisticCamera::Traced> RealisticCamera::trace(double x, double y, Point2f lens) const {
  // The picture is upside down on the film: raster (0, 0) is at its right and bottom for who looks on.
  const Vec3d film{(0.5 - x / params_.fullResolution.x) * filmSize_.x,
                   (y / params_.fullResolution.y - 0.5) * filmSize_.y, 0};
  const double distance = std::hypot(film.x, film.y);
  const ExitPupil::Rectangle& bounds = pupil_.at(distance);
  const double u = lerp(double{lens.x}, bounds.min.x, bounds.max.x);
  const double v = lerp(double{lens.y}, bounds.min.y, bounds.max.y);
  const double cosine = distance > 0 ? film.x / distance : 1, sine = distance > 0 ? film.y / distance : 0;
  const Vec3d rear{cosine * u - sine * v, sine * u + cosine * v, lens_.rearZ()};
  const Vec3d d = normalize(rear - film);
  const auto out = lens_.traceFromFilm({film, d});
  if (!out) return std::nullopt;
  const double share = params_.simpleWeighting ? bounds.area() / pupil_.centralArea()
                                               : (double{params_.shutterClose} - params_.shutterOpen) *
                                                     bounds.area() / sqr(lens_.rearZ());
  return Traced{*out, sqr(sqr(d.z)) * share};
}

Camera::WeightedRay RealisticCamera::generateRay(Point2f film, Point2f lens, float time) const {
  WeightedRay r;
  r.ray.time = rayTime(time);
  const Transform world =
      worldFromCamera().isAnimated() ? worldFromCamera().at(r.ray.time) : worldFromCamera().start();
  const auto traced = trace(film.x, film.y, lens);
  if (!traced) {
    r.weight = 0;
    r.ray.o = Point3f(world.point(Vec3d{0, 0, lens_.frontZ()}));
    r.ray.d = Vector3f(normalize(world.vector(Vec3d{0, 0, 1})));
    return r;
  }
  const auto direction = [&](const LensRay& ray) { return normalize(world.vector(ray.d)); };
  const Vec3d o = world.point(traced->ray.o), d = direction(traced->ray);
  r.weight = static_cast<float>(traced->weight);
  r.ray.o = Point3f(o);
  r.ray.d = Vector3f(d);
  if (!wantsDifferentials()) return r;
  // Forward differences, or backward where the neighbour is stopped by the lens.
  const auto shift = [&](double x, double y, Point3f& origin, Vector3f& towards) {
    for (const double step : {kStep, -kStep}) {
      const auto near = trace(film.x + step * x, film.y + step * y, lens);
      if (!near) continue;
      origin = Point3f(o + (world.point(near->ray.o) - o) / step);
      towards = Vector3f(d + (direction(near->ray) - d) / step);
      return true;
    }
    return false;
  };
  r.ray.hasDifferentials =
      shift(1, 0, r.ray.rxOrigin, r.ray.rxDirection) && shift(0, 1, r.ray.ryOrigin, r.ray.ryDirection);
  return r;
}

}  // namespace pbrtmedia
