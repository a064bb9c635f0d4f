// SPDX-License-Identifier: BSD-2-Clause
#include "lights/infinite.h"

#include <numbers>

#include "base/warp.h"

namespace pbrtmedia {

InfiniteLight::InfiniteLight(const Transform& worldFromLight, const Params& params)
    : Light(params.samples), directions_(worldFromLight, "infinite"), radiance_(params.radiance) {
  if (params.map) map_.emplace(*params.map).prepareSampling(radiance_);
}

void InfiniteLight::preprocess(const Bounds3f& sceneBounds) { scene_ = BoundingSphere(sceneBounds); }

LightSample InfiniteLight::sample(Point3f, Point2f u) const {
  LightSample s;
  if (!map_) {
    s.wi = sampleUniformSphere(u);
    s.radiance = radiance_;
    s.pdf = pdfUniformSphere();
    return s;
  }
  const SphereMap::Sample onMap = map_->sample(u);
  s.wi = directions_.toWorld(onMap.w);
  s.radiance = radiance_ * onMap.value;
  s.pdf = onMap.pdf * directions_.jacobian(s.wi);
  return s;
}

float InfiniteLight::pdf(Point3f, Vector3f wi, const SurfaceInteraction*) const {
  if (!map_) return pdfUniformSphere();
  return map_->pdf(directions_.toLight(wi)) * directions_.jacobian(wi);
}

LeSample InfiniteLight::sampleLe(Point2f uPosition, Point2f uDirection, float time) const {
  const LightSample from = sample({}, uDirection);
  LeSample s{.ray = scene_.entering(-from.wi, uPosition, time),
             .normal = -from.wi,
             .radiance = from.radiance,
             .pdf = {}};
  const float pdfPosition = scene_.pdfEntering(s.ray);
  if (pdfPosition > 0) s.pdf = {.position = pdfPosition, .direction = from.pdf};
  return s;
}

LePdf InfiniteLight::pdfLe(const Ray& ray, Normal3f) const {
  return {.position = scene_.pdfEntering(ray), .direction = pdf({}, -ray.d, nullptr)};
}

Rgb InfiniteLight::background(Vector3f direction) const {
  if (!map_) return radiance_;
  return radiance_ * map_->lookup(directions_.toLight(direction));
}

Rgb InfiniteLight::power() const {
  return static_cast<float>(std::numbers::pi * sqr(scene_.radius())) * radiance_ *
         (map_ ? map_->mean() : Rgb(1));
}

}  // namespace pbrtmedia
