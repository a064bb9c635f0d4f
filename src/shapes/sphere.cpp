// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/sphere.h"

#include <numbers>

#include "shapes/parameter_checks.h"

namespace pbrtmedia {
namespace {

/// Relative to the coordinates: points this near to a sphere may lie on it, rounded.
constexpr double kOnSurface = 1e-6;

double polarAngle(double radius, double z) {
  return std::atan2(safeSqrt((radius - z) * (radius + z)), z);  // unlike acos precise at the poles
}

}  // namespace

RevolvedQuadric::Profile Sphere::profileOf(const Params& params) {
  requirePositive("radius", params.radius);
  const double r = params.radius;
  const float a = params.zmin.value_or(-params.radius), b = params.zmax.value_or(params.radius);
  if (std::isnan(a)) rejectParameter("zmin", "a number", a);
  if (std::isnan(b)) rejectParameter("zmax", "a number", b);
  const double zMin = std::clamp(static_cast<double>(std::min(a, b)), -r, r);
  const double zMax = std::clamp(static_cast<double>(std::max(a, b)), -r, r);
  if (zMin == zMax) rejectParameter("zmax", "a part of [-radius, radius] between zmin and zmax", b);
  return {.c0 = r * r,
          .c2 = -1,
          .zMin = zMin,
          .zMax = zMax,
          .phiMax = sweepAngle(params.phimax),
          .clipsZ = zMin > -r || zMax < r};
}

Sphere::Sphere(const Params& params, const ShapePlacement& placement)
    : RevolvedQuadric(placement, profileOf(params)),
      radius_(params.radius),
      thetaMin_(polarAngle(radius_, profile().zMin)),
      thetaMax_(polarAngle(radius_, profile().zMax)),
      isComplete_(!profile().clipsZ && profile().phiMax >= 2 * std::numbers::pi) {}

double Sphere::vAt(double z) const { return (polarAngle(radius_, z) - thetaMin_) / (thetaMax_ - thetaMin_); }

RevolvedQuadric::HeightDerivatives Sphere::heightDerivatives(double z) const {
  const double range = thetaMax_ - thetaMin_;
  return {-range * safeSqrt((radius_ - z) * (radius_ + z)), -range * range * z};
}

Quadric::Derivatives Sphere::derivatives(Vec3d p) const {
  const double distance = std::hypot(p.x, p.y), floor = 1e-5 * radius_;
  const Vec3d radial = distance > 0 ? Vec3d(p.x / distance, p.y / distance, 0) : Vec3d(1, 0, 0);
  const Vec3d around{-radial.y, radial.x, 0};
  const double r = std::max(distance, floor), phi = profile().phiMax, theta = thetaMax_ - thetaMin_;
  return {.dpdu = phi * r * around,
          .dpdv = theta * (p.z * radial - Vec3d(0, 0, distance)),
          .d2pduu = -phi * phi * r * radial,
          .d2pduv = theta * phi * p.z * around,
          .d2pdvv = -theta * theta * p};
}

std::optional<double> Sphere::coneFrom(Vec3d reference, Point3f referenceWorld) const {
  if (!isComplete_) return std::nullopt;
  const double d = length(reference);
  const double rounding = kOnSurface * (radius_ + inverseScale() * maxComponent(abs(Vec3d(referenceWorld))));
  if (!(d > radius_ + rounding)) return std::nullopt;
  const double sine = radius_ / d, cosine = std::sqrt((d - radius_) * (d + radius_)) / d;
  return sine * sine / (1 + cosine);
}

double Sphere::worldDensity(double objectDensity, Vec3d d) const {
  // A linear map M changes the solid angle around d by |det M| / |M d|³.
  const double stretch = length(worldFromObject().vector(d));
  return objectDensity * stretch * stretch * stretch / volumeScale();
}

double Sphere::areaSampledByPbrt(std::uint32_t) const { return 4 * std::numbers::pi * radius_ * radius_; }

ShapeSample Sphere::sample(std::uint32_t primitive, Point3f reference, Point2f u) const {
  const Vec3d from = objectPoint(Vec3d(reference));
  const auto cone = coneFrom(from, reference);
  if (!cone) return Quadric::sample(primitive, reference, u);
  const double d = length(from);
  const double oneMinusCos = u.x * *cone, phi = 2 * std::numbers::pi * u.y;
  const double sine = safeSqrt(oneMinusCos * (2 - oneMinusCos));
  // Law of sines in the triangle centre - reference - surface point; alpha is the angle at the centre.
  const double alpha = std::asin(std::min(1.0, d * sine / radius_)) - std::asin(sine);
  const Vec3d z = from / d;  // from the centre to the reference
  const auto [x, y] = coordinateSystem(z);
  const Vec3d across = std::cos(phi) * x + std::sin(phi) * y;
  ShapeSample s = sampleAt(radius_ * (std::sin(alpha) * across + std::cos(alpha) * z));
  const Vec3d direction = sine * across - (1 - oneMinusCos) * z;
  const auto pdf = static_cast<float>(worldDensity(1 / (2 * std::numbers::pi * *cone), direction));
  s.pdf = std::isfinite(pdf) ? pdf : 0;
  return s;
}

float Sphere::pdf(std::uint32_t primitive, Point3f reference, Vector3f wi, Point3f p, Normal3f n) const {
  const auto cone = coneFrom(objectPoint(Vec3d(reference)), reference);
  if (!cone) return Quadric::pdf(primitive, reference, wi, p, n);
  const Vec3d direction = normalize(objectVector(Vec3d(wi)));
  if (dot(objectPoint(Vec3d(p)), direction) > 0) return 0;  // the far side is never sampled
  const auto pdf = static_cast<float>(worldDensity(1 / (2 * std::numbers::pi * *cone), direction));
  return std::isfinite(pdf) ? pdf : 0;
}

}  // namespace pbrtmedia
