// SPDX-License-Identifier: BSD-2-Clause
#include "lights/point.h"

#include "base/warp.h"
#include "lights/light_geometry.h"

namespace pbrtmedia {

PointLight::PointLight(const Transform& worldFromLight, const Params& params)
    : position_(Point3f(worldFromLight.point(Vec3d{0, 0, 0}) + Vec3d(params.from))),
      intensity_(params.intensity) {}

LightSample PointLight::sample(Point3f reference, Point2f) const {
  LightSample s = sampleTowardPoint(position_, reference);
  s.radiance *= intensity_;
  return s;
}

LeSample PointLight::sampleLe(Point2f, Point2f uDirection, float time) const {
  return emissionFromPoint(position_, sampleUniformSphere(uDirection), time, intensity_, pdfUniformSphere());
}

LePdf PointLight::pdfLe(const Ray&, Normal3f) const {
  return {.position = 0, .direction = pdfUniformSphere()};
}

Rgb PointLight::power() const { return 4 * kPi * intensity_; }

}  // namespace pbrtmedia
