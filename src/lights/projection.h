// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "base/transform.h"
#include "lights/light.h"
#include "lights/light_map.h"

namespace pbrtmedia {

/// `LightSource "projection"`: a slide projector at the light space origin looking along +z. The window spans
/// ±1 on the shorter axis of the picture; the top row of the picture lies toward −y.
class ProjectionLight final : public Light {
 public:
  struct Params {
    Rgb intensity{1.0f};  ///< "I" times "scale", W/sr
    float fov = 45;       ///< full angle of the ±1 span, degrees, in (0, 180)
    /// "mapname", read without gamma decoding; none: factor 1 in a square window
    std::optional<Image> map = std::nullopt;
  };
  /// Throws std::invalid_argument when `fov` is out of range, the transform has no inverse or the map is
  /// unusable (see LightMap).
  ProjectionLight(const Transform& worldFromLight, const Params& params);

  std::string_view typeName() const override { return "projection"; }
  bool isDelta() const override { return true; }
  std::optional<Point3f> deltaPosition() const override { return position_; }
  void clipToLit(Vec3d o, Vec3d d, double& tMin, double& tMax) const override;
  LightSample sample(Point3f reference, Point2f u) const override;
  float pdf(Point3f, Vector3f, const SurfaceInteraction*) const override { return 0; }
  Rgb power() const override;
  Point3f position() const { return position_; }

 private:
  /// Factor on the intensity toward light-space direction `w` (any length).
  Rgb projected(Vector3f w) const;

  Affine3f lightFromWorld_;
  Point3f position_;
  Rgb intensity_;
  float tanHalfFov_;
  Vector2f halfWindow_{1, 1};  ///< screen units, in x and y
  std::optional<LightMap> map_;
};

}  // namespace pbrtmedia
