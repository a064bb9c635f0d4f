// SPDX-License-Identifier: BSD-2-Clause
#include "lights/spot.h"

#include <stdexcept>

#include "lights/light_geometry.h"

namespace pbrtmedia {

SpotLight::SpotLight(const Transform& worldFromLight, const Params& params)
    : lightFromWorld_(worldFromLight.inverse()),
      position_(worldFromLight.point(params.from)),
      intensity_(params.intensity),
      cosTotal_(std::cos(radians(double{params.coneAngle}))),
      cosFalloffStart_(std::cos(radians(double{params.coneAngle} - params.coneDeltaAngle))) {
  if (worldFromLight.isSingular()) {
    throw std::invalid_argument("spot light: the transform has no inverse");
  }
  const Vec3d axis = Vec3d(params.to) - Vec3d(params.from);
  if (!(lengthSquared(axis) > 0)) {
    throw std::invalid_argument("spot light: \"from\" and \"to\" are the same point");
  }
  axis_ = normalize(axis);
}

double SpotLight::falloff(double cosine) const {
  if (cosine < cosTotal_) return 0;
  if (cosine >= cosFalloffStart_) return 1;
  return sqr(sqr((cosine - cosTotal_) / (cosFalloffStart_ - cosTotal_)));
}

LightSample SpotLight::sample(Point3f reference, Point2f) const {
  LightSample s = sampleTowardPoint(position_, reference);
  if (s.pdf == 0) return s;
  const Vec3d w = lightFromWorld_.vector(Vec3d(reference) - Vec3d(position_));
  s.radiance *= intensity_ * static_cast<float>(falloff(dot(w, axis_) / length(w)));
  return s;
}

Rgb SpotLight::power() const {
  return 2 * kPi * static_cast<float>(1 - 0.5 * (cosFalloffStart_ + cosTotal_)) * intensity_;
}

}  // namespace pbrtmedia
