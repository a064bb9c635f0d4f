// SPDX-License-Identifier: BSD-2-Clause
#include "lights/diffuse_area.h"

namespace pbrtmedia {

DiffuseAreaLight::DiffuseAreaLight(const Shape& shape, std::uint32_t primitive, PrimitiveId target,
                                   const Params& params)
    : AreaLight(params.samples),
      shape_(&shape),
      primitive_(primitive),
      target_(target),
      radiance_(params.radiance),
      twoSided_(params.twoSided),
      isSampledFromBehind_(shape.isSampledFromBehind()) {}

LightSample DiffuseAreaLight::sample(Point3f reference, Point2f u) const {
  LightSample s;
  const ShapeSample onShape = shape_->sample(primitive_, reference, u);
  const Vec3d d = Vec3d(onShape.p) - Vec3d(reference);
  const double squared = lengthSquared(d);
  if (!(onShape.pdf > 0) || !(squared > 0)) return s;
  const double r = std::sqrt(squared);
  s.wi = Vector3f(d / r);
  s.distance = static_cast<float>(r);
  s.pdf = onShape.pdf;
  s.radiance = emitted(isSampledFromBehind_ ? -onShape.n : onShape.n, -s.wi);
  s.target = target_;
  return s;
}

float DiffuseAreaLight::pdf(Point3f reference, Vector3f wi, const SurfaceInteraction* hit) const {
  return hit ? shape_->pdf(primitive_, reference, wi, hit->p, hit->n) : 0;
}

Rgb DiffuseAreaLight::power() const {
  return static_cast<float>((twoSided_ ? 2 : 1) * kPi * shape_->area(primitive_)) * radiance_;
}

Rgb DiffuseAreaLight::emitted(Normal3f normal, Vector3f wo) const {
  return twoSided_ || dot(normal, wo) > 0 ? radiance_ : Rgb();
}

}  // namespace pbrtmedia
