// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/transform.h"
#include "lights/light.h"
#include "lights/light_directions.h"

namespace pbrtmedia {

/// `LightSource "spot"`: full intensity inside a cone, falling off as a fourth power in the cosine over its
/// outer ring. The angle from the axis is measured in light space.
class SpotLight final : public Light {
 public:
  struct Params {
    Rgb intensity{1.0f};       ///< "I" times "scale", W/sr
    Point3f from{0, 0, 0};     ///< light space
    Point3f to{0, 0, 1};       ///< light space
    float coneAngle = 30;      ///< half-angle of the whole cone, degrees
    float coneDeltaAngle = 5;  ///< width of the ring in which the light falls off, degrees
  };
  /// Throws std::invalid_argument when `from` equals `to` or the transform has no inverse.
  SpotLight(const Transform& worldFromLight, const Params& params);

  std::string_view typeName() const override { return "spot"; }
  bool isDelta() const override { return true; }
  std::optional<Point3f> deltaPosition() const override { return position_; }
  void clipToLit(Vec3d o, Vec3d d, double& tMin, double& tMax) const override;
  LightSample sample(Point3f reference, Point2f u) const override;
  float pdf(Point3f, Vector3f, const SurfaceInteraction*) const override { return 0; }
  LeSample sampleLe(Point2f uPosition, Point2f uDirection, float time) const override;
  LePdf pdfLe(const Ray& ray, Normal3f normal) const override;
  Rgb power() const override;
  std::optional<LightExtent> extent() const override;
  Point3f position() const { return position_; }
  /// Fraction of the intensity at `cosine` of the angle from the axis: 0 outside the cone, 1 inside the ring.
  double falloff(double cosine) const;

 private:
  /// Cosine of the angle from the axis of a world-space direction of any length.
  double cosineOf(Vec3d world) const;
  /// Of `sampleLe` for unit world-space `d`, where the falloff is `factor`.
  float directionPdf(Vector3f d, double factor) const;

  Transform lightFromWorld_;
  LightDirections directions_;
  Point3f position_;
  Vec3d axis_;  ///< unit, light space
  Rgb intensity_;
  double cosTotal_, cosFalloffStart_;
  /// Solid angles in light space over 2π: of the part of full intensity, and of the ring times its mean
  /// falloff.
  double innerShare_, ringShare_;
};

}  // namespace pbrtmedia
