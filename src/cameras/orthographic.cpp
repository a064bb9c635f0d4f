// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/orthographic.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/warp.h"
#include "cameras/camera_checks.h"

namespace pbrtmedia {
namespace {

constexpr double kDirectionRounding = 4e-7;  // of unit directions in single precision

}  // namespace

OrthographicCamera::OrthographicCamera(const AnimatedTransform& worldFromCamera, const Params& params)
    : Camera(worldFromCamera, params.shutterOpen, params.shutterClose),
      film_{params.fullResolution},
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

OrthographicCamera::Placed OrthographicCamera::placedAt(float time) const {
  return worldFromCamera().isAnimated() ? place(worldFromCamera().at(time)) : fixed_;
}

Camera::WeightedRay OrthographicCamera::generateRay(Point2f film, Point2f lens, float time) const {
  const float t = rayTime(time);
  const Placed placed = placedAt(t);
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
  r.ray.d = Vector3f(normalize(direction));
  r.ray.time = t;
  if (!wantsDifferentials()) return r;
  r.ray.rxOrigin = Point3f(origin + placed.right);
  r.ray.ryOrigin = Point3f(origin + placed.down);
  r.ray.rxDirection = r.ray.ryDirection = r.ray.d;
  r.ray.hasDifferentials = true;
  return r;
}

// generateRay the other way round: p = corner + x right + y down + offset + t d.
std::optional<OrthographicCamera::View> OrthographicCamera::view(const Placed& placed, Vec3d p,
                                                                 Vec3d lensOffset, Vec3d d) const {
  const auto xyt = coefficients(placed.right, placed.down, d, p - lensOffset - placed.corner);
  if (!xyt) return std::nullopt;
  const std::optional<Point2f> film = film_.at(xyt->x, xyt->y);
  if (!film) return std::nullopt;
  const double pixelAcross = absDot(cross(placed.right, placed.down), d);
  return View{*film, xyt->z, 1 / (film_.area() * pixelAcross)};
}

double OrthographicCamera::pdfDirection(const Placed& placed, Vec3d d, double lengthOfD) const {
  if (seesOneDirection()) return 0;
  const double lensAcross = std::numbers::pi * absDot(cross(placed.lensX, placed.lensY), d);
  return sqr(lengthOfD / inverseFocalDistance_) / lensAcross;
}

std::optional<OrthographicCamera::LensPoint> OrthographicCamera::lensPoint(const Placed& placed,
                                                                           Vec3d d) const {
  if (seesOneDirection()) return LensPoint{{}, 0};
  const auto abs = coefficients(inverseFocalDistance_ * placed.lensX, inverseFocalDistance_ * placed.lensY, d,
                                placed.forward);
  if (!abs || !(abs->z > 0)) return std::nullopt;
  const double fromCentre = std::hypot(abs->x, abs->y);
  if (fromCentre > 1 + kDirectionRounding / (lensRadius_ * inverseFocalDistance_)) return std::nullopt;
  const Vec3d offset = (abs->x * placed.lensX + abs->y * placed.lensY) / std::max(fromCentre, 1.0);
  return LensPoint{offset, pdfDirection(placed, d, abs->z)};
}

Importance OrthographicCamera::we(const Ray& ray) const {
  const Placed placed = placedAt(ray.time);
  const auto lens = lensPoint(placed, Vec3d(ray.d));
  if (!lens) return {};
  const auto seen = view(placed, Vec3d(ray.o), lens->offset, Vec3d(ray.d));
  if (!seen) return {};
  return {static_cast<float>(seen->pdfAcross * (seesOneDirection() ? 1 : lens->pdfDirection)), seen->film};
}

WePdf OrthographicCamera::pdfWe(const Ray& ray) const {
  const Placed placed = placedAt(ray.time);
  const auto lens = lensPoint(placed, Vec3d(ray.d));
  if (!lens) return {};
  const auto seen = view(placed, Vec3d(ray.o), lens->offset, Vec3d(ray.d));
  if (!seen) return {};
  return {.position = static_cast<float>(seen->pdfAcross),
          .direction = static_cast<float>(lens->pdfDirection)};
}

WiSample OrthographicCamera::sampleWi(Point3f reference, Point2f lens, float time) const {
  const Placed placed = placedAt(time);
  Vec3d offset{};
  if (lensRadius_ > 0) {
    const Point2f disk = sampleConcentricDisk(lens);
    offset = double{disk.x} * placed.lensX + double{disk.y} * placed.lensY;
  }
  const Vec3d toFocus = placed.forward - offset * inverseFocalDistance_;
  const double lengthOfD = length(toFocus);
  const Vec3d d = toFocus / lengthOfD;
  const auto seen = view(placed, Vec3d(reference), offset, d);
  if (!seen || !(seen->t > 0)) return {};
  const double pdf = seesOneDirection() ? 1 : pdfDirection(placed, d, lengthOfD);
  return {.importance = static_cast<float>(seen->pdfAcross * pdf),
          .wi = Vector3f(-d),
          .distance = static_cast<float>(seen->t),
          .pdf = static_cast<float>(pdf),
          .film = seen->film};
}

}  // namespace pbrtmedia
