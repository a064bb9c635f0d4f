// SPDX-License-Identifier: BSD-2-Clause
#include "lights/goniometric.h"

#include <cmath>
#include <stdexcept>

#include "lights/light_geometry.h"

namespace pbrtmedia {

GoniometricLight::GoniometricLight(const Transform& worldFromLight, const Params& params)
    : lightFromWorld_(worldFromLight.inverseMatrix()),
      position_(worldFromLight.point(Point3f{0, 0, 0})),
      intensity_(params.intensity) {
  if (worldFromLight.isSingular()) {
    throw std::invalid_argument("goniometric light: the transform has no inverse");
  }
  if (params.map) map_.emplace(*params.map);
}

LightSample GoniometricLight::sample(Point3f reference, Point2f) const {
  LightSample s = sampleTowardPoint(position_, reference);
  if (s.pdf == 0) return s;
  s.radiance *= intensity_;
  if (map_) {
    const Vector3f w = lightFromWorld_.vector(-s.wi);
    s.radiance *= map_->lookup(latLong({w.x, w.z, w.y}));
  }
  return s;
}

Rgb GoniometricLight::power() const { return 4 * kPi * intensity_ * (map_ ? map_->mean() : Rgb(1)); }

}  // namespace pbrtmedia
