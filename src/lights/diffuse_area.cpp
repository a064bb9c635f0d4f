// SPDX-License-Identifier: BSD-2-Clause
#include "lights/diffuse_area.h"

#include "base/warp.h"

namespace pbrtmedia {

DiffuseAreaLight::DiffuseAreaLight(const Shape& shape, std::uint32_t primitive, const Params& params)
    : AreaLight(params.samples),
      shape_(&shape),
      primitive_(primitive),
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
  s.n = onShape.n;
  s.radiance = emitted(emittingNormal(onShape.n), -s.wi);
  return s;
}

float DiffuseAreaLight::pdf(Point3f reference, Vector3f wi, const SurfaceInteraction* hit) const {
  return hit ? shape_->pdf(primitive_, reference, wi, hit->p, hit->n) : 0;
}

LeSample DiffuseAreaLight::sampleLe(Point2f uPosition, Point2f uDirection, float time) const {
  const ShapeSample onShape = shape_->sample(primitive_, uPosition);
  Normal3f side = emittingNormal(onShape.n);
  if (twoSided_) {
    const bool isBack = uDirection.x >= 0.5f;
    uDirection.x = std::min(2 * (isBack ? uDirection.x - 0.5f : uDirection.x), kOneMinusEpsilon);
    if (isBack) side = -side;
  }
  const Vector3f d = Frame::fromZ(side).toWorld(sampleCosineHemisphere(uDirection));
  LeSample s{
      .ray = {.o = onShape.p, .d = d, .time = time}, .normal = onShape.n, .radiance = radiance_, .pdf = {}};
  if (onShape.pdf > 0) s.pdf = {.position = onShape.pdf, .direction = directionPdf(onShape.n, d)};
  return s;
}

LePdf DiffuseAreaLight::pdfLe(const Ray& ray, Normal3f normal) const {
  const auto pdfPosition = static_cast<float>(shape_->areaDensity(primitive_, normal));
  if (!std::isfinite(pdfPosition)) return {};
  return {.position = pdfPosition, .direction = directionPdf(normal, ray.d)};
}

float DiffuseAreaLight::directionPdf(Normal3f normal, Vector3f d) const {
  const float cosine = dot(emittingNormal(normal), d);
  return twoSided_ ? 0.5f * pdfCosineHemisphere(std::abs(cosine)) : pdfCosineHemisphere(cosine);
}

Rgb DiffuseAreaLight::power() const {
  return static_cast<float>((twoSided_ ? 2 : 1) * kPi * shape_->area(primitive_)) * radiance_;
}

Rgb DiffuseAreaLight::emitted(Normal3f normal, Vector3f wo) const {
  return twoSided_ || dot(normal, wo) > 0 ? radiance_ : Rgb();
}

}  // namespace pbrtmedia
