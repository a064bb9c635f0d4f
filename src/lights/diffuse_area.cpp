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

// A triangle shines to one side; what a normal is on other shapes changes over them.
std::optional<LightExtent> DiffuseAreaLight::extent() const {
  LightExtent extent{.bounds = shape_->bounds(), .solidAngle = (twoSided_ ? 2 : 1) * kPi};
  const Shape::Geometry geometry = shape_->geometry();
  const auto* const triangles = std::get_if<TriangleBuffers>(&geometry);
  if (!triangles) return extent;
  extent.bounds = {};
  for (const std::uint32_t corner : triangles->indices[primitive_])
    extent.bounds.expand(triangles->positions[corner]);
  if (twoSided_) return extent;
  // Hits are turned toward their shading normal, which may change sides inside; linear as it is, it does so
  // between corners if anywhere.
  const Normal3f n = shape_->sample(primitive_, {0, 0}).n;
  for (const Point2f u : {Point2f{kOneMinusEpsilon, 0}, Point2f{kOneMinusEpsilon, kOneMinusEpsilon}}) {
    if (dot(shape_->sample(primitive_, u).n, n) < 0) return extent;
  }
  extent.axis = Vector3f(emittingNormal(n));
  extent.spread = 0;
  return extent;
}

Rgb DiffuseAreaLight::emitted(Normal3f normal, Vector3f wo) const {
  return twoSided_ || dot(normal, wo) > 0 ? radiance_ : Rgb();
}

}  // namespace pbrtmedia
