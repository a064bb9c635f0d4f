// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "cameras/camera.h"
#include "cameras/full_film.h"
#include "cameras/screen_window.h"

namespace pbrtmedia {

/// `Camera "perspective"`: pinhole or thin lens. Screen point (sx, sy) is seen along
/// (sx tan(fov/2), sy tan(fov/2), 1) of the left-handed camera space (x right, y up, z into the scene); with
/// a lens all rays of a film point meet at z = focalDistance. Weight 1.
class PerspectiveCamera final : public Camera {
 public:
  struct Params {
    Point2i fullResolution{1280, 720};  ///< of the whole film, whatever the crop
    ScreenWindow screenWindow = screenWindowOfAspect(1280.0f / 720.0f);
    float fov = 90;              ///< degrees over screen −1…+1, in (0, 180)
    float lensRadius = 0;        ///< camera-space units, >= 0
    float focalDistance = 1e6f;  ///< z of the focal plane, camera-space units, > 0
    float shutterOpen = 0, shutterClose = 1;
  };
  /// Throws std::invalid_argument, naming the value, for a parameter out of range.
  PerspectiveCamera(const AnimatedTransform& worldFromCamera, const Params& params);

  WeightedRay generateRay(Point2f film, Point2f lens, float time) const override;
  Importance we(const Ray& ray) const override;
  WePdf pdfWe(const Ray& ray) const override;
  WiSample sampleWi(Point3f reference, Point2f lens, float time) const override;

 private:
  /// The camera in world space at one time: what a ray is made of.
  struct Placed {
    Vec3d eye;
    Vec3d lensX, lensY;         ///< a step of lensRadius on the lens
    Vec3d corner, right, down;  ///< direction of raster (0, 0) at camera z = 1, and its change per pixel
  };
  Placed place(const Transform& worldFromCamera) const;
  Placed placedAt(float time) const;
  /// A ray from the lens seen by the film.
  struct View {
    Point2f film;
    double pdfDirection;
  };
  std::optional<View> view(const Placed& placed, Vec3d lensOffset, Vec3d d) const;

  FullFilm film_;
  ScreenFromRaster screen_;
  double tanHalfFov_;
  double lensRadius_, inverseFocalDistance_;
  Placed fixed_;  ///< at the start time
};

}  // namespace pbrtmedia
