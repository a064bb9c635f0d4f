// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "base/animated_transform.h"
#include "base/vec.h"

namespace pbrtmedia {

/// The rectangle of the screen plane that the full film shows, y up. In units of tan(fov/2) for the
/// perspective camera, of camera space for the orthographic one.
struct ScreenWindow {
  float xMin = -1, xMax = 1, yMin = -1, yMax = 1;
  bool operator==(const ScreenWindow&) const = default;
};

/// The window of a frame of the given width / height: ±1 on the shorter side. Throws std::invalid_argument
/// unless 0 < aspect < infinity.
ScreenWindow screenWindowOfAspect(float aspect);

/// The window in effect: "screenwindow" if given, else by "frameaspectratio" if given, else by the full film.
ScreenWindow resolveScreenWindow(Point2i fullResolution, std::optional<float> frameAspectRatio,
                                 std::optional<ScreenWindow> screenWindow);

/// Full angle in degrees over screen −1…+1: twice `halfFov` if that is positive, else `fov`.
float resolveFov(float fov, float halfFov);

/// Screen position of a raster position (pixels of the full film, y down): an affine map, kept in double so
/// that neighbouring pixels of a narrow view stay apart.
class ScreenFromRaster {
 public:
  /// Throws std::invalid_argument when the resolution is not positive or the window is empty or not finite.
  /// A window with reversed limits mirrors the picture.
  ScreenFromRaster(Point2i fullResolution, const ScreenWindow& window);
  Point2d operator()(double x, double y) const { return {x0_ + x * dx_, y0_ + y * dy_}; }
  double xPerPixel() const { return dx_; }
  double yPerPixel() const { return dy_; }  ///< negative for an upright window

 private:
  double x0_, y0_, dx_, dy_;
};

/// Whether an axis of the camera changes its squared length by more than 0.1 % (worth a warning: focal
/// distance and lens radius are in camera units).
bool cameraScales(const AnimatedTransform& worldFromCamera);

}  // namespace pbrtmedia
