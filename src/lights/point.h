// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/transform.h"
#include "lights/light.h"

namespace pbrtmedia {

/// `LightSource "point"`: the same intensity in all directions, irradiance I cosθ / r².
class PointLight final : public Light {
 public:
  struct Params {
    Rgb intensity{1.0f};  ///< "I" times "scale", W/sr
    /// World-space offset: added to the light's origin after the CTM, neither turned nor scaled by it.
    Point3f from{0, 0, 0};
  };
  PointLight(const Transform& worldFromLight, const Params& params);

  std::string_view typeName() const override { return "point"; }
  bool isDelta() const override { return true; }
  std::optional<Point3f> deltaPosition() const override { return position_; }
  LightSample sample(Point3f reference, Point2f u) const override;
  float pdf(Point3f, Vector3f, const SurfaceInteraction*) const override { return 0; }
  LeSample sampleLe(Point2f uPosition, Point2f uDirection, float time) const override;
  LePdf pdfLe(const Ray& ray, Normal3f normal) const override;
  Rgb power() const override;
  std::optional<LightExtent> extent() const override { return LightExtent{.bounds = {position_, position_}}; }
  Point3f position() const { return position_; }

 private:
  Point3f position_;
  Rgb intensity_;
};

}  // namespace pbrtmedia
