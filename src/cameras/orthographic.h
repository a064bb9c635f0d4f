// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "cameras/camera.h"
#include "cameras/full_film.h"
#include "cameras/screen_window.h"

namespace pbrtmedia {

/// `Camera "orthographic"`: parallel rays along camera +z from (sx, sy, 0), the screen window being in
/// camera-space units. Deviation from PBRT-v3, which loses (sx, sy) when there is a lens: here the lens
/// sample is an offset from (sx, sy), and all rays of a film point meet at (sx, sy, focalDistance). Weight 1.
/// The importance of a ray finds its lens point, and so its raster position, by the direction: only as
/// precisely as single precision tells the directions of a lens apart that is small before its focal
/// distance.
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
  Importance we(const Ray& ray) const override;
  WePdf pdfWe(const Ray& ray) const override;
  WiSample sampleWi(Point3f reference, Point2f lens, float time) const override;

 private:
  /// The camera in world space at one time: what a ray is made of.
  struct Placed {
    Vec3d corner, right, down;  ///< origin of raster (0, 0), and its change per pixel
    Vec3d lensX, lensY;         ///< a step of lensRadius on the lens
    Vec3d forward;              ///< camera +z
  };
  Placed place(const Transform& worldFromCamera) const;
  Placed placedAt(float time) const;
  /// What the film sees along a direction.
  struct View {
    Point2f film;
    double t;          ///< of a point, along the direction from the lens
    double pdfAcross;  ///< density of positions, per area across the direction
  };
  /// Of the point `p` along unit `d`, through the lens point of that offset.
  std::optional<View> view(const Placed& placed, Vec3d p, Vec3d lensOffset, Vec3d d) const;
  /// Where on the lens rays along a direction leave it.
  struct LensPoint {
    Vec3d offset;
    double pdfDirection;  ///< solid angle; 0 where all rays have one direction
  };
  std::optional<LensPoint> lensPoint(const Placed& placed, Vec3d d) const;
  bool seesOneDirection() const { return lensRadius_ == 0 || inverseFocalDistance_ == 0; }
  /// `lengthOfD`: of forward less the lens offset over the focal distance, which points along `d`.
  double pdfDirection(const Placed& placed, Vec3d d, double lengthOfD) const;

  FullFilm film_;
  ScreenFromRaster screen_;
  double lensRadius_, inverseFocalDistance_;
  Placed fixed_;  ///< at the start time
};

}  // namespace pbrtmedia
