// SPDX-License-Identifier: BSD-2-Clause
#include "lights/spot.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lights/light_geometry.h"

namespace pbrtmedia {
namespace {

constexpr double kDistanceRoom = 1e-6;  // of the distances involved: some float spacings

}  // namespace

SpotLight::SpotLight(const Transform& worldFromLight, const Params& params)
    : lightFromWorld_(worldFromLight.inverse()),
      directions_(worldFromLight, "spot"),
      position_(worldFromLight.point(params.from)),
      intensity_(params.intensity),
      cosTotal_(std::cos(radians(double{params.coneAngle}))),
      cosFalloffStart_(std::cos(radians(double{params.coneAngle} - params.coneDeltaAngle))) {
  const Vec3d axis = Vec3d(params.to) - Vec3d(params.from);
  if (!(lengthSquared(axis) > 0)) {
    throw std::invalid_argument("spot light: \"from\" and \"to\" are the same point");
  }
  axis_ = normalize(axis);
  const double start = std::max(cosFalloffStart_, cosTotal_);
  innerShare_ = 1 - start;
  ringShare_ = (start - cosTotal_) / 5;  // the mean of x⁴ on [0, 1]
}

double SpotLight::cosineOf(Vec3d world) const {
  const Vec3d w = lightFromWorld_.vector(world);
  return dot(w, axis_) / length(w);
}

double SpotLight::falloff(double cosine) const {
  if (cosine < cosTotal_) return 0;
  if (cosine >= cosFalloffStart_) return 1;
  return sqr(sqr((cosine - cosTotal_) / (cosFalloffStart_ - cosTotal_)));
}

void SpotLight::clipToLit(Vec3d o, Vec3d d, double& tMin, double& tMax) const {
  if (!(cosTotal_ > 0)) return;  // a cone of 90 degrees or more: what is dark is not worth cutting out
  // Light space, apex at the origin: inside where cos² |w|² <= (w . axis)² and w . axis > 0.
  const Vec3d w0 = lightFromWorld_.vector(o - Vec3d(position_)), w1 = lightFromWorld_.vector(d);
  const double along0 = dot(w0, axis_), along1 = dot(w1, axis_), cos2 = sqr(cosTotal_);
  const double a = sqr(along1) - cos2 * lengthSquared(w1), b = along0 * along1 - cos2 * dot(w0, w1),
               c = sqr(along0) - cos2 * lengthSquared(w0);
  const double discriminant = b * b - a * c;
  if (a == 0 || !(discriminant >= 0)) {
    if (a < 0) tMax = -kInfinity;  // never inside
    return;
  }
  const double root = std::sqrt(discriminant);
  const double low = (-b + (a > 0 ? -root : root)) / a, high = (-b + (a > 0 ? root : -root)) / a;
  // Points are rounded to single precision before the light is asked, so the cut leaves that much room.
  const double room = kDistanceRoom * (length(w0) / length(w1) + std::abs(low) + std::abs(high));
  if (a < 0) {  // both crossings on one half of the double cone
    if (along0 + (low + high) / 2 * along1 < 0) {
      tMax = -kInfinity;
      return;
    }
    tMin = std::max(tMin, low - room);
    tMax = std::min(tMax, high + room);
  } else if (along1 > 0) {
    tMin = std::max(tMin, high - room);
  } else {
    tMax = std::min(tMax, low + room);
  }
}

LightSample SpotLight::sample(Point3f reference, Point2f) const {
  LightSample s = sampleTowardPoint(position_, reference);
  if (s.pdf == 0) return s;
  s.radiance *= intensity_ * static_cast<float>(falloff(cosineOf(Vec3d(reference) - Vec3d(position_))));
  return s;
}

// In proportion to the intensity: uniform in the inner cone; in the ring the cosine is the fifth root of a
// uniform number.
LeSample SpotLight::sampleLe(Point2f, Point2f uDirection, float time) const {
  const double share = double{uDirection.x} * (innerShare_ + ringShare_);
  double oneMinusCos = share;
  if (share >= innerShare_) {
    const double fromEdge = std::pow(std::max(0.0, 1 - (share - innerShare_) / ringShare_), 0.2);
    oneMinusCos = (1 - cosTotal_) - 5 * ringShare_ * fromEdge;
  }
  const double sine = safeSqrt(oneMinusCos * (2 - oneMinusCos)),
               phi = 2 * std::numbers::pi * double{uDirection.y};
  const auto [x, y] = coordinateSystem(axis_);
  const Vec3d w = sine * (std::cos(phi) * x + std::sin(phi) * y) + (1 - oneMinusCos) * axis_;
  const Vector3f d(normalize(lightFromWorld_.inverse().vector(w)));
  const double factor = falloff(cosineOf(Vec3d(d)));
  return emissionFromPoint(position_, d, time, static_cast<float>(factor) * intensity_,
                           directionPdf(d, factor));
}

LePdf SpotLight::pdfLe(const Ray& ray, Normal3f) const {
  return {.position = 0, .direction = directionPdf(ray.d, falloff(cosineOf(Vec3d(ray.d))))};
}

float SpotLight::directionPdf(Vector3f d, double factor) const {
  const double whole = 2 * std::numbers::pi * (innerShare_ + ringShare_);
  return whole > 0 ? static_cast<float>(factor / whole) * directions_.jacobian(d) : 0;
}

std::optional<LightExtent> SpotLight::extent() const {
  const auto angle = static_cast<float>(std::acos(std::clamp(cosTotal_, -1.0, 1.0)));
  return LightExtent{
      .bounds = {position_, position_},
      .axis = Vector3f(normalize(lightFromWorld_.inverse().vector(axis_))),
      .spread = angle,
      .fade = 0,
      .solidAngle = static_cast<float>(2 * std::numbers::pi * (1 - 0.5 * (cosFalloffStart_ + cosTotal_)))};
}

Rgb SpotLight::power() const {
  return 2 * kPi * static_cast<float>(1 - 0.5 * (cosFalloffStart_ + cosTotal_)) * intensity_;
}

}  // namespace pbrtmedia
