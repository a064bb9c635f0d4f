// SPDX-License-Identifier: BSD-2-Clause
#include "lights/projection.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "lights/light_geometry.h"

namespace pbrtmedia {
namespace {

constexpr float kNearZ = 0.001f;  // cosine from the axis below which nothing is projected (reference 16.5)

constexpr std::size_t kCellsWithoutMap = 16;  // per axis: follow the solid angle over a wide window

constexpr double kRoom = 1e-5;  // relative room for single-precision points and transforms

}  // namespace

ProjectionLight::ProjectionLight(const Transform& worldFromLight, const Params& params)
    : directions_(worldFromLight, "projection"),
      position_(worldFromLight.point(Point3f{0, 0, 0})),
      intensity_(params.intensity),
      tanHalfFov_(std::tan(radians(params.fov) / 2)) {
  if (!(params.fov > 0 && params.fov < 180)) {
    throw std::invalid_argument("projection light: fov must lie in (0, 180) degrees, found " +
                                std::to_string(params.fov));
  }
  if (params.map) {
    map_.emplace(*params.map);
    const float aspect = map_->aspect();
    halfWindow_ = aspect > 1 ? Vector2f{aspect, 1} : Vector2f{1, 1 / aspect};
  }
}

void ProjectionLight::prepareEmission() {
  // A texel has the solid angle cos³θ times its area on the screen plane.
  const std::size_t columns = map_ ? static_cast<std::size_t>(map_->width()) : kCellsWithoutMap,
                    rows = map_ ? static_cast<std::size_t>(map_->height()) : kCellsWithoutMap;
  std::vector<float> weights = map_ ? map_->cellMeans(intensity_) : std::vector<float>(columns * rows, 1.0f);
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const Point2f centre{(static_cast<float>(x) + 0.5f) / static_cast<float>(columns),
                           (static_cast<float>(y) + 0.5f) / static_cast<float>(rows)};
      const float cosine = 1 / length(throughWindow(centre));
      weights[y * columns + x] *= cosine * cosine * cosine;
    }
  }
  cells_ = Distribution2D(weights, columns, rows);
}

Vector3f ProjectionLight::throughWindow(Point2f uv) const {
  return {(2 * uv.x - 1) * halfWindow_.x * tanHalfFov_, (2 * uv.y - 1) * halfWindow_.y * tanHalfFov_, 1};
}

std::optional<Point2f> ProjectionLight::windowPoint(Vector3f w) const {
  if (!(w.z >= kNearZ * length(w))) return std::nullopt;
  const float scale = 1 / (w.z * tanHalfFov_), x = w.x * scale, y = w.y * scale;
  if (std::abs(x) > halfWindow_.x || std::abs(y) > halfWindow_.y) return std::nullopt;
  return Point2f{(x / halfWindow_.x + 1) / 2, (y / halfWindow_.y + 1) / 2};
}

Rgb ProjectionLight::projected(Vector3f w) const {
  const std::optional<Point2f> uv = windowPoint(w);
  if (!uv) return {};
  return map_ ? map_->lookup(*uv) : Rgb(1);
}

void ProjectionLight::clipToLit(Vec3d o, Vec3d d, double& tMin, double& tMax) const {
  // In light space the picture is the cone |x| <= halfWidth z, |y| <= halfHeight z: four planes.
  const Affine3f& m = directions_.lightFromWorld();
  const auto toLight = [&](Vec3d v) { return v.x * Vec3d(m.x) + v.y * Vec3d(m.y) + v.z * Vec3d(m.z); };
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
  s.radiance *= intensity_ * projected(directions_.toLight(-s.wi));
  return s;
}

LeSample ProjectionLight::sampleLe(Point2f, Point2f uDirection, float time) const {
  const Vector3f d = directions_.toWorld(throughWindow(cells_.sample(uDirection).p));
  return emissionFromPoint(position_, d, time, intensity_ * projected(directions_.toLight(d)),
                           directionPdf(d));
}

LePdf ProjectionLight::pdfLe(const Ray& ray, Normal3f) const {
  return {.position = 0, .direction = directionPdf(ray.d)};
}

float ProjectionLight::directionPdf(Vector3f d) const {
  const Vector3f w = directions_.toLight(d);
  const std::optional<Point2f> uv = windowPoint(w);
  if (!uv) return 0;
  const float cosine = w.z / length(w), area = 4 * halfWindow_.x * halfWindow_.y * sqr(tanHalfFov_);
  return cells_.pdf(*uv) / (area * cosine * cosine * cosine) * directions_.jacobian(d);
}

Rgb ProjectionLight::power() const {
  const double tanCorner2 =
      sqr(double{tanHalfFov_}) * (sqr(double{halfWindow_.x}) + sqr(double{halfWindow_.y}));
  const double cosCorner = 1 / std::sqrt(1 + tanCorner2);
  return 2 * kPi * static_cast<float>(1 - cosCorner) * intensity_ * (map_ ? map_->mean() : Rgb(1));
}

}  // namespace pbrtmedia
