// SPDX-License-Identifier: BSD-2-Clause
#include "lights/projection.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "lights/light_geometry.h"

namespace pbrtmedia {
namespace {

constexpr float kNearZ = 0.001f;  // cosine from the axis below which nothing is projected (reference 16.5)

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
