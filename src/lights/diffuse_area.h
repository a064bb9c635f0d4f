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
  /// `shape` must outlive the light; `primitive` counts inside it.
  DiffuseAreaLight(const Shape& shape, std::uint32_t primitive, const Params& params);

  std::string_view typeName() const override { return "diffuse"; }
  bool isDelta() const override { return false; }
  bool isSplit() const override { return isSampledFromBehind_ && !twoSided_; }
  LightSample sample(Point3f reference, Point2f u) const override;
  float pdf(Point3f reference, Vector3f wi, const SurfaceInteraction* hit) const override;
  LeSample sampleLe(Point2f uPosition, Point2f uDirection, float time) const override;
  LePdf pdfLe(const Ray& ray, Normal3f normal) const override;
  Rgb power() const override;
  std::optional<LightExtent> extent() const override;
  Rgb emitted(Normal3f normal, Vector3f wo) const override;

 private:
  /// Solid-angle density of `sampleLe` for unit `d` where the normal of hits is `normal`.
  float directionPdf(Normal3f normal, Vector3f d) const;
  /// The normal that decides what light samples see emitting.
  Normal3f emittingNormal(Normal3f normal) const { return isSampledFromBehind_ ? -normal : normal; }

  const Shape* shape_;
  std::uint32_t primitive_;
  Rgb radiance_;
  bool twoSided_;
  bool isSampledFromBehind_;
};

}  // namespace pbrtmedia
