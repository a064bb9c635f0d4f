// SPDX-License-Identifier: BSD-2-Clause
#include "lights/projection.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "lights/light_geometry.h"

namespace pbrtmedia {
namespace {

constexpr float kNearZ = 0.001f;  // cosine from the axis below which nothing is projected (reference 16.5)

constexpr double kRoom = 1e-5;  // relative room for single-precision points and transforms

}  // namespace

ProjectionLight::ProjectionLight(const Transform& worldFromLight, const Params& params)
    : lightFromWorld_(worldFromLight.inverseMatrix()),
      position_(worldFromLight.point(Point3f{0, 0, 0})),
      intensity_(params.intensity),
      tanHalfFov_(std::tan(radians(params.fov) / 2)) {
  if (!(params.fov > 0 && params.fov < 180)) {
    throw std::invalid_argument("projection light: fov must lie in (0, 180) degrees, found " +
                                std::to_string(params.fov));
  }
  if (worldFromLight.isSingular()) {
    throw std::invalid_argument("projection light: the transform has no inverse");
  }
  if (!params.map) return;
  map_.emplace(*params.map);
  const float aspect = map_->aspect();
  halfWindow_ = aspect > 1 ? Vector2f{aspect, 1} : Vector2f{1, 1 / aspect};
}

Rgb ProjectionLight::projected(Vector3f w) const {
  if (!(w.z >= kNearZ * length(w))) return {};
  const float scale = 1 / (w.z * tanHalfFov_), x = w.x * scale, y = w.y * scale;
  if (std::abs(x) > halfWindow_.x || std::abs(y) > halfWindow_.y) return {};
  if (!map_) return Rgb(1);
  return map_->lookup({(x / halfWindow_.x + 1) / 2, (y / halfWindow_.y + 1) / 2});
}

void ProjectionLight::clipToLit(Vec3d o, Vec3d d, double& tMin, double& tMax) const {
  // In light space the picture is the cone |x| <= halfWidth z, |y| <= halfHeight z: four planes.
  const auto toLight = [&](Vec3d v) {
    return v.x * Vec3d(lightFromWorld_.x) + v.y * Vec3d(lightFromWorld_.y) + v.z * Vec3d(lightFromWorld_.z);
  };
  const Vec3d w0 = toLight(o - Vec3d(position_)), w1 = toLight(d);
  const double room = kRoom * length(w0);
  const auto clip = [&](Vec3d normal) {
    const double height = dot(w0, normal) + room, slope = dot(w1, normal);
    if (slope > 0) tMin = std::max(tMin, -height / slope);
    if (slope < 0) tMax = std::min(tMax, -height / slope);
    if (slope == 0 && height < 0) tMax = -kInfinity;
  };
  const double x = double{halfWindow_.x} * double{tanHalfFov_} * (1 + kRoom),
               y = double{halfWindow_.y} * double{tanHalfFov_} * (1 + kRoom);
  clip(normalize(Vec3d(1, 0, x)));
  clip(normalize(Vec3d(-1, 0, x)));
  clip(normalize(Vec3d(0, 1, y)));
  clip(normalize(Vec3d(0, -1, y)));
}

LightSample ProjectionLight::sample(Point3f reference, Point2f) const {
  LightSample s = sampleTowardPoint(position_, reference);
  if (s.pdf == 0) return s;
  s.radiance *= intensity_ * projected(lightFromWorld_.vector(-s.wi));
  return s;
}

Rgb ProjectionLight::power() const {
  const double tanCorner2 =
      sqr(double{tanHalfFov_}) * (sqr(double{halfWindow_.x}) + sqr(double{halfWindow_.y}));
  const double cosCorner = 1 / std::sqrt(1 + tanCorner2);
  return 2 * kPi * static_cast<float>(1 - cosCorner) * intensity_ * (map_ ? map_->mean() : Rgb(1));
}

}  // namespace pbrtmedia
