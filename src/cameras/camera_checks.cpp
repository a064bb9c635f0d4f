// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/camera_checks.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace pbrtmedia {

void requireInvertible(const AnimatedTransform& worldFromCamera) {
  if (worldFromCamera.start().isSingular() || worldFromCamera.end().isSingular()) {
    throw std::invalid_argument("the camera transform has no inverse");
  }
}

double checkedInverseFocalDistance(float lensRadius, float focalDistance) {
  if (!(lensRadius >= 0) || !std::isfinite(lensRadius)) {
    throw std::invalid_argument("lens radius must be >= 0, found " + std::to_string(lensRadius));
  }
  if (lensRadius == 0) return 0;
  if (!(focalDistance > 0)) {
    throw std::invalid_argument("focal distance must be > 0, found " + std::to_string(focalDistance));
  }
  return 1 / double{focalDistance};
}

void requireShutter(float open, float close) {
  if (!std::isfinite(open) || !std::isfinite(close) || open > close) {
    throw std::invalid_argument("shutter must open before it closes, found " + std::to_string(open) + " to " +
                                std::to_string(close));
  }
}

}  // namespace pbrtmedia
