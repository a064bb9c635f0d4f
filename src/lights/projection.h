// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "base/distribution.h"
#include "base/transform.h"
#include "lights/light.h"
#include "lights/light_directions.h"
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
  void prepareEmission() override;
  LeSample sampleLe(Point2f uPosition, Point2f uDirection, float time) const override;
  LePdf pdfLe(const Ray& ray, Normal3f normal) const override;
  Rgb power() const override;
  std::optional<LightExtent> extent() const override { return LightExtent{.bounds = {position_, position_}}; }
  Point3f position() const { return position_; }

 private:
  /// Factor on the intensity toward light-space direction `w` (any length).
  Rgb projected(Vector3f w) const;

  /// Solid-angle density of `sampleLe` at a unit world direction.
  float directionPdf(Vector3f d) const;
  /// Light-space direction, with z = 1, of a point of the window in map coordinates.
  Vector3f throughWindow(Point2f uv) const;
  /// Map coordinates in the window of light-space direction `w`; nothing outside of it.
  std::optional<Point2f> windowPoint(Vector3f w) const;

  LightDirections directions_;
  Point3f position_;
  Rgb intensity_;
  float tanHalfFov_;
  Vector2f halfWindow_{1, 1};  ///< screen units, in x and y
  std::optional<LightMap> map_;
  Distribution2D cells_;  ///< of the light through parts of the window: the texels, if there is a map. After
                          ///< prepareEmission
};

}  // namespace pbrtmedia
