// SPDX-License-Identifier: BSD-2-Clause
#include "lights/distant.h"

#include <stdexcept>

namespace pbrtmedia {

DistantLight::DistantLight(const Transform& worldFromLight, const Params& params)
    : radiance_(params.radiance) {
  const Vec3d travel = worldFromLight.vector(Vec3d(params.to) - Vec3d(params.from));
  if (!(lengthSquared(travel) > 0)) {
    throw std::invalid_argument("distant light: \"from\" and \"to\" are the same point");
  }
  toLight_ = Vector3f(-normalize(travel));
}

void DistantLight::preprocess(const Bounds3f& sceneBounds) { scene_ = BoundingSphere(sceneBounds); }

LightSample DistantLight::sample(Point3f, Point2f) const {
  LightSample s;
  s.radiance = radiance_;
  s.wi = toLight_;
  s.pdf = 1;
  return s;
}

LeSample DistantLight::sampleLe(Point2f uPosition, Point2f, float time) const {
  LeSample s{.ray = scene_.entering(-toLight_, uPosition, time),
             .normal = -toLight_,
             .radiance = radiance_,
             .pdf = {}};
  const float pdfPosition = scene_.pdfEntering(s.ray);
  if (pdfPosition > 0) s.pdf = {.position = pdfPosition, .direction = 1};
  return s;
}

LePdf DistantLight::pdfLe(const Ray& ray, Normal3f) const {
  return {.position = scene_.pdfEntering(ray), .direction = 0};
}

Rgb DistantLight::power() const { return static_cast<float>(kPi * sqr(scene_.radius())) * radiance_; }

}  // namespace pbrtmedia
