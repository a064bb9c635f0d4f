// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "cameras/camera.h"
#include "cameras/screen_window.h"

namespace pbrtmedia {

/// `Camera "orthographic"`: parallel rays along camera +z from (sx, sy, 0), the screen window being in
/// camera-space units. Deviation from PBRT-v3, which loses (sx, sy) when there is a lens: here the lens
/// sample is an offset from (sx, sy), and all rays of a film point meet at (sx, sy, focalDistance). Weight 1.
class OrthographicCamera final : public Camera {
 public:
  struct Params {
    Point2i fullResolution{1280, 720};  ///< of the whole film, whatever the crop
    ScreenWindow screenWindow = screenWindowOfAspect(1280.0f / 720.0f);
    float lensRadius = 0;        ///< camera-space units, >= 0
    float focalDistance = 1e6f;  ///< z of the focal plane, camera-space units, > 0
    float shutterOpen = 0, shutterClose = 1;
  };
  /// Throws std::invalid_argument, naming the value, for a parameter out of range.
  OrthographicCamera(const AnimatedTransform& worldFromCamera, const Params& params);

  WeightedRay generateRay(Point2f film, Point2f lens, float time) const override;

 private:
  /// The camera in world space at one time: what a ray is made of.
  struct Placed {
    Vec3d corner, right, down;  ///< origin of raster (0, 0), and its change per pixel
    Vec3d lensX, lensY;         ///< a step of lensRadius on the lens
    Vec3d forward;              ///< camera +z
  };
  Placed place(const Transform& worldFromCamera) const;

  ScreenFromRaster screen_;
  double lensRadius_, inverseFocalDistance_;
  Placed fixed_;  ///< at the start time
};

}  // namespace pbrtmedia
