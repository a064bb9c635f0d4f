// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/perspective.h"

#include <cmath>
#include <numbers>
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
      film_{params.fullResolution},
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

PerspectiveCamera::Placed PerspectiveCamera::placedAt(float time) const {
  return worldFromCamera().isAnimated() ? place(worldFromCamera().at(time)) : fixed_;
}

Camera::WeightedRay PerspectiveCamera::generateRay(Point2f film, Point2f lens, float time) const {
  const float t = rayTime(time);
  const Placed placed = placedAt(t);
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
  r.ray.o = Point3f(origin);
  r.ray.d = Vector3f(normalize(direction));
  r.ray.time = t;
  if (!wantsDifferentials()) return r;
  r.ray.rxOrigin = r.ray.ryOrigin = r.ray.o;
  r.ray.rxDirection = Vector3f(normalize(direction + placed.right));
  r.ray.ryDirection = Vector3f(normalize(direction + placed.down));
  r.ray.hasDifferentials = true;
  return r;
}

// generateRay the other way round: corner + x right + y down - offset / focalDistance = s d with s > 0.
std::optional<PerspectiveCamera::View> PerspectiveCamera::view(const Placed& placed, Vec3d lensOffset,
                                                               Vec3d d) const {
  const auto xys =
      coefficients(placed.right, placed.down, -d, lensOffset * inverseFocalDistance_ - placed.corner);
  if (!xys || !(xys->z > 0)) return std::nullopt;
  const std::optional<Point2f> film = film_.at(xys->x, xys->y);
  if (!film) return std::nullopt;
  // A pixel is |right x down| large on the plane that is s away along d.
  const double pixel = absDot(cross(placed.right, placed.down), d) / sqr(xys->z);
  return View{*film, 1 / (film_.area() * pixel)};
}

Importance PerspectiveCamera::we(const Ray& ray) const {
  const Placed placed = placedAt(ray.time);
  const Vec3d d(ray.d);
  const auto seen = view(placed, lensRadius_ > 0 ? Vec3d(ray.o) - placed.eye : Vec3d{}, d);
  if (!seen) return {};
  const double lensAcross =
      lensRadius_ > 0 ? std::numbers::pi * absDot(cross(placed.lensX, placed.lensY), d) : 1;
  return {static_cast<float>(seen->pdfDirection / lensAcross), seen->film};
}

WePdf PerspectiveCamera::pdfWe(const Ray& ray) const {
  const Placed placed = placedAt(ray.time);
  const auto seen = view(placed, lensRadius_ > 0 ? Vec3d(ray.o) - placed.eye : Vec3d{}, Vec3d(ray.d));
  if (!seen) return {};
  const double pdfLens =
      lensRadius_ > 0 ? 1 / (std::numbers::pi * length(cross(placed.lensX, placed.lensY))) : 0;
  return {.position = static_cast<float>(pdfLens), .direction = static_cast<float>(seen->pdfDirection)};
}

WiSample PerspectiveCamera::sampleWi(Point3f reference, Point2f lens, float time) const {
  const Placed placed = placedAt(time);
  Vec3d offset{};
  if (lensRadius_ > 0) {
    const Point2f disk = sampleConcentricDisk(lens);
    offset = double{disk.x} * placed.lensX + double{disk.y} * placed.lensY;
  }
  const Vec3d from = Vec3d(reference) - (placed.eye + offset);
  const double distance2 = lengthSquared(from), distance = std::sqrt(distance2);
  if (!(distance > 0)) return {};
  const Vec3d d = from / distance;
  const auto seen = view(placed, offset, d);
  if (!seen) return {};
  WiSample s{.importance = static_cast<float>(seen->pdfDirection / distance2),
             .wi = Vector3f(-d),
             .distance = static_cast<float>(distance),
             .pdf = 1,
             .film = seen->film};
  if (lensRadius_ > 0) {
    const double lensAcross = std::numbers::pi * absDot(cross(placed.lensX, placed.lensY), d);
    s.importance = static_cast<float>(seen->pdfDirection / lensAcross);
    s.pdf = static_cast<float>(distance2 / lensAcross);
  }
  return s;
}

}  // namespace pbrtmedia
