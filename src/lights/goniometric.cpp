// SPDX-License-Identifier: BSD-2-Clause
#include "lights/goniometric.h"

#include <cmath>
#include <stdexcept>

#include "base/warp.h"
#include "lights/light_geometry.h"

namespace pbrtmedia {
namespace {

/// Between light space, where the map's pole is +y, and the map's own, where it is +z.
Vector3f exchanged(Vector3f w) { return {w.x, w.z, w.y}; }

}  // namespace

GoniometricLight::GoniometricLight(const Transform& worldFromLight, const Params& params)
    : directions_(worldFromLight, "goniometric"),
      position_(worldFromLight.point(Point3f{0, 0, 0})),
      intensity_(params.intensity) {
  if (params.map) map_.emplace(*params.map);
}

void GoniometricLight::prepareEmission() {
  if (map_) map_->prepareSampling(intensity_);
}

LightSample GoniometricLight::sample(Point3f reference, Point2f) const {
  LightSample s = sampleTowardPoint(position_, reference);
  if (s.pdf == 0) return s;
  s.radiance *= intensity_;
  if (map_) s.radiance *= map_->lookup(exchanged(directions_.toLight(-s.wi)));
  return s;
}

LeSample GoniometricLight::sampleLe(Point2f, Point2f uDirection, float time) const {
  if (!map_) {
    return emissionFromPoint(position_, sampleUniformSphere(uDirection), time, intensity_,
                             pdfUniformSphere());
  }
  const SphereMap::Sample s = map_->sample(uDirection);
  const Vector3f d = directions_.toWorld(exchanged(s.w));
  return emissionFromPoint(position_, d, time, intensity_ * s.value, s.pdf * directions_.jacobian(d));
}

LePdf GoniometricLight::pdfLe(const Ray& ray, Normal3f) const {
  if (!map_) return {.position = 0, .direction = pdfUniformSphere()};
  return {.position = 0,
          .direction = map_->pdf(exchanged(directions_.toLight(ray.d))) * directions_.jacobian(ray.d)};
}

Rgb GoniometricLight::power() const { return 4 * kPi * intensity_ * (map_ ? map_->mean() : Rgb(1)); }

}  // namespace pbrtmedia
