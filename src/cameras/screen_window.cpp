// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/screen_window.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace pbrtmedia {

ScreenWindow screenWindowOfAspect(float aspect) {
  if (!(aspect > 0) || !std::isfinite(aspect)) {
    throw std::invalid_argument("frame aspect ratio must be positive, found " + std::to_string(aspect));
  }
  if (aspect > 1) return {-aspect, aspect, -1, 1};
  return {-1, 1, -1 / aspect, 1 / aspect};
}

ScreenWindow resolveScreenWindow(Point2i fullResolution, std::optional<float> frameAspectRatio,
                                 std::optional<ScreenWindow> screenWindow) {
  if (screenWindow) return *screenWindow;
  if (frameAspectRatio) return screenWindowOfAspect(*frameAspectRatio);
  return screenWindowOfAspect(static_cast<float>(fullResolution.x) / static_cast<float>(fullResolution.y));
}

float resolveFov(float fov, float halfFov) { return halfFov > 0 ? 2 * halfFov : fov; }

ScreenFromRaster::ScreenFromRaster(Point2i fullResolution, const ScreenWindow& w)
    : x0_(w.xMin),
      y0_(w.yMax),
      dx_((double{w.xMax} - w.xMin) / fullResolution.x),
      dy_((double{w.yMin} - w.yMax) / fullResolution.y) {
  if (fullResolution.x <= 0 || fullResolution.y <= 0) {
    throw std::invalid_argument("film resolution must be positive, found " +
                                std::to_string(fullResolution.x) + " x " + std::to_string(fullResolution.y));
  }
  if (!std::isfinite(x0_) || !std::isfinite(y0_) || !std::isfinite(dx_) || !std::isfinite(dy_) || dx_ == 0 ||
      dy_ == 0) {
    throw std::invalid_argument("screen window must be finite and not empty, found " +
                                std::to_string(w.xMin) + ' ' + std::to_string(w.xMax) + ' ' +
                                std::to_string(w.yMin) + ' ' + std::to_string(w.yMax));
  }
}

bool cameraScales(const AnimatedTransform& worldFromCamera) {
  constexpr double kTolerance = 1e-3;  // of the squared length, as the scene language has it
  for (const Transform* t : {&worldFromCamera.start(), &worldFromCamera.end()}) {
    for (const Vec3d axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
      if (std::abs(lengthSquared(t->vector(axis)) - 1) > kTolerance) return true;
    }
  }
  return false;
}

}  // namespace pbrtmedia
