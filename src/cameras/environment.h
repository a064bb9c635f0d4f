// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "cameras/camera.h"
#include "cameras/full_film.h"

namespace pbrtmedia {

/// `Camera "environment"`: latitude-longitude panorama with θ = π y/height from camera +y and φ = 2π x/width,
/// direction (sinθ cosφ, cosθ, sinθ sinφ). Weight 1.
class EnvironmentCamera final : public Camera {
 public:
  struct Params {
    Point2i fullResolution{1280, 720};  ///< of the whole film, whatever the crop
    float shutterOpen = 0, shutterClose = 1;
  };
  /// Throws std::invalid_argument, naming the value, for a parameter out of range.
  EnvironmentCamera(const AnimatedTransform& worldFromCamera, const Params& params);

  WeightedRay generateRay(Point2f film, Point2f lens, float time) const override;
  Importance we(const Ray& ray) const override;
  WePdf pdfWe(const Ray& ray) const override;
  WiSample sampleWi(Point3f reference, Point2f lens, float time) const override;

 private:
  Transform placedAt(float time) const;
  /// What the film sees along unit `d`, per solid angle.
  Importance seenAlong(const Transform& worldFromCameraNow, Vec3d d) const;

  FullFilm film_;
  double thetaPerPixel_, phiPerPixel_;
};

}  // namespace pbrtmedia
