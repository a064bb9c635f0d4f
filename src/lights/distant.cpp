// SPDX-License-Identifier: BSD-2-Clause
#include "lights/distant.h"

#include <stdexcept>

#include "lights/light_geometry.h"

namespace pbrtmedia {

DistantLight::DistantLight(const Transform& worldFromLight, const Params& params)
    : radiance_(params.radiance) {
  const Vec3d travel = worldFromLight.vector(Vec3d(params.to) - Vec3d(params.from));
  if (!(lengthSquared(travel) > 0)) {
    throw std::invalid_argument("distant light: \"from\" and \"to\" are the same point");
  }
  toLight_ = Vector3f(-normalize(travel));
}

void DistantLight::preprocess(const Bounds3f& sceneBounds) {
  sceneRadius_ = boundingSphereRadius(sceneBounds);
}

LightSample DistantLight::sample(Point3f, Point2f) const {
  LightSample s;
  s.radiance = radiance_;
  s.wi = toLight_;
  s.pdf = 1;
  return s;
}

Rgb DistantLight::power() const { return static_cast<float>(kPi * sqr(sceneRadius_)) * radiance_; }

}  // namespace pbrtmedia
