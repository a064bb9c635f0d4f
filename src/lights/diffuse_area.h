// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "lights/light.h"
#include "shapes/shape.h"

namespace pbrtmedia {

/// `AreaLightSource "diffuse"` on one primitive of a shape: the same radiance from every point in every
/// direction of the hemisphere around the surface normal, or of both when two-sided. Samples of shapes that
/// are sampled from behind emit around the opposite of the normal, as in PBRT-v3.
class DiffuseAreaLight final : public AreaLight {
 public:
  struct Params {
    Rgb radiance{1.0f};     ///< "L" times "scale", W/(m² sr)
    bool twoSided = false;  ///< "twosided"
    int samples = 1;        ///< "samples"
  };
  /// `shape` must outlive the light; `primitive` counts inside it. `target` is how the accelerator names that
  /// primitive.
  DiffuseAreaLight(const Shape& shape, std::uint32_t primitive, PrimitiveId target, const Params& params);

  std::string_view typeName() const override { return "diffuse"; }
  bool isDelta() const override { return false; }
  bool isSplit() const override { return isSampledFromBehind_ && !twoSided_; }
  LightSample sample(Point3f reference, Point2f u) const override;
  float pdf(Point3f reference, Vector3f wi, const SurfaceInteraction* hit) const override;
  Rgb power() const override;
  Rgb emitted(Normal3f normal, Vector3f wo) const override;
  PrimitiveId target() const { return target_; }

 private:
  const Shape* shape_;
  std::uint32_t primitive_;
  PrimitiveId target_;
  Rgb radiance_;
  bool twoSided_;
  bool isSampledFromBehind_;
};

}  // namespace pbrtmedia
