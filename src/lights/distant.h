// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/transform.h"
#include "lights/light.h"
#include "lights/light_geometry.h"

namespace pbrtmedia {

/// `LightSource "distant"`: parallel light that travels from `from` toward `to`. L acts as irradiance on a
/// surface perpendicular to it. Not visible to rays that leave the scene.
class DistantLight final : public Light {
 public:
  struct Params {
    Rgb radiance{1.0f};     ///< "L" times "scale"
    Point3f from{0, 0, 0};  ///< light space
    Point3f to{0, 0, 1};    ///< light space
  };
  /// Throws std::invalid_argument when `from` equals `to` (in world space).
  DistantLight(const Transform& worldFromLight, const Params& params);

  std::string_view typeName() const override { return "distant"; }
  bool isDelta() const override { return true; }
  void preprocess(const Bounds3f& sceneBounds) override;
  LightSample sample(Point3f reference, Point2f u) const override;
  float pdf(Point3f, Vector3f, const SurfaceInteraction*) const override { return 0; }
  LeSample sampleLe(Point2f uPosition, Point2f uDirection, float time) const override;
  LePdf pdfLe(const Ray& ray, Normal3f normal) const override;
  /// π R² L with the radius R of the scene's bounding sphere, known after `preprocess`.
  Rgb power() const override;
  std::optional<LightExtent> extent() const override {
    return LightExtent{.axis = -toLight_, .spread = 0, .fade = 0};
  }
  /// Unit, world space, from any point toward the light.
  Vector3f toLight() const { return toLight_; }

 private:
  Vector3f toLight_;
  Rgb radiance_;
  BoundingSphere scene_;
};

}  // namespace pbrtmedia
