// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "base/transform.h"
#include "lights/light.h"
#include "lights/light_directions.h"
#include "lights/sphere_map.h"

namespace pbrtmedia {

/// `LightSource "goniometric"`: a point light at the light space origin whose intensity is multiplied by a
/// latitude-longitude map with the pole on +y: θ from +y, φ = atan2(z, x), row 0 of the picture at +y.
class GoniometricLight final : public Light {
 public:
  struct Params {
    Rgb intensity{1.0f};                      ///< "I" times "scale", W/sr
    std::optional<Image> map = std::nullopt;  ///< "mapname", read without gamma decoding; none: factor 1
  };
  /// Throws std::invalid_argument when the transform has no inverse or the map is unusable (see LightMap).
  GoniometricLight(const Transform& worldFromLight, const Params& params);

  std::string_view typeName() const override { return "goniometric"; }
  bool isDelta() const override { return true; }
  std::optional<Point3f> deltaPosition() const override { return position_; }
  LightSample sample(Point3f reference, Point2f u) const override;
  float pdf(Point3f, Vector3f, const SurfaceInteraction*) const override { return 0; }
  void prepareEmission() override;
  LeSample sampleLe(Point2f uPosition, Point2f uDirection, float time) const override;
  LePdf pdfLe(const Ray& ray, Normal3f normal) const override;
  Rgb power() const override;
  std::optional<LightExtent> extent() const override { return LightExtent{.bounds = {position_, position_}}; }
  Point3f position() const { return position_; }

 private:
  LightDirections directions_;
  Point3f position_;
  Rgb intensity_;
  std::optional<SphereMap> map_;  ///< with its pole on +z: y and z are exchanged
};

}  // namespace pbrtmedia
