// SPDX-License-Identifier: BSD-2-Clause
#include "lights/point.h"

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

Rgb PointLight::power() const { return 4 * kPi * intensity_; }

}  // namespace pbrtmedia
