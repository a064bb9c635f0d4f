// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "base/transform.h"
#include "lights/light.h"
#include "lights/light_directions.h"
#include "lights/light_geometry.h"
#include "lights/sphere_map.h"

namespace pbrtmedia {

/// `LightSource "infinite"`: radiance from all around, constant or from a latitude-longitude map whose pole
/// (top row) is light-space +z and whose left edge is +x: u = atan2(y, x)/2π, v = acos(z)/π.
/// A map is sampled as SphereMap does. Without one the sphere is sampled uniformly.
class InfiniteLight final : public Light {
 public:
  struct Params {
    Rgb radiance{1.0f};  ///< "L" times "scale", W/(m² sr)
    /// "mapname", read without gamma decoding; multiplies the radiance
    std::optional<Image> map = std::nullopt;
    int samples = 1;  ///< "samples"
  };
  /// Throws std::invalid_argument when the transform has no inverse or the map is unusable (see LightMap).
  /// A transform that scales unevenly is followed exactly: directions are mapped and normalised.
  InfiniteLight(const Transform& worldFromLight, const Params& params);

  std::string_view typeName() const override { return "infinite"; }
  bool isDelta() const override { return false; }
  bool isInfinite() const override { return true; }
  bool isUniformInfinite() const override { return !map_; }
  void preprocess(const Bounds3f& sceneBounds) override;
  LightSample sample(Point3f reference, Point2f u) const override;
  float pdf(Point3f reference, Vector3f wi, const SurfaceInteraction* hit) const override;
  LeSample sampleLe(Point2f uPosition, Point2f uDirection, float time) const override;
  LePdf pdfLe(const Ray& ray, Normal3f normal) const override;
  Rgb background(Vector3f direction) const override;
  /// π R² times the mean radiance, with the radius R of the scene's bounding sphere, known after
  /// `preprocess`.
  Rgb power() const override;
  std::optional<LightExtent> extent() const override { return LightExtent{}; }

 private:
  LightDirections directions_;
  Rgb radiance_;
  BoundingSphere scene_;
  std::optional<SphereMap> map_;
};

}  // namespace pbrtmedia
