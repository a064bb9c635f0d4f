// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "cameras/camera.h"
#include "cameras/exit_pupil.h"
#include "cameras/lens_system.h"

namespace pbrtmedia {

/// `Camera "realistic"`: a film behind a system of lenses, all in metres. The film is centred at the origin
/// of camera space, x right and y up for who looks along +z; the picture on it stands on its head, which is
/// turned. Scene-language reference 9.4.
///
/// A ray is traced from the film through the exit pupil, sampled by area in a rectangle around it. Its weight
/// is cos⁴θ A / A₀ under simple weighting, A being the area of that rectangle and A₀ that at the centre of
/// the film, so that the centre is about as bright as with other cameras, up to a factor that the lens
/// decides: A₀ is the area of the rectangle, not of the pupil in it. Otherwise it is (shutterClose -
/// shutterOpen) cos⁴θ A / z², z being the distance of the rear element: exposure in seconds, as irradiance. A
/// ray that the lens stops has the weight 0. θ is the angle to the axis at the film.
///
/// No importance is known (as in PBRT-v3): light paths do not find this camera.
class RealisticCamera final : public Camera {
 public:
  struct Params {
    Point2i fullResolution{1280, 720};  ///< of the whole film, whatever the crop
    double filmDiagonal = 0.035;        ///< metres, > 0
    double focusDistance = 10;          ///< metres from the film
    bool simpleWeighting = true;
    float shutterOpen = 0, shutterClose = 1;
  };
  /// Throws std::invalid_argument, naming the value, for a parameter out of range and for a lens that cannot
  /// be focused.
  RealisticCamera(const AnimatedTransform& worldFromCamera, const LensSystem& lens, const Params& params);

  WeightedRay generateRay(Point2f film, Point2f lens, float time) const override;
  bool hasImportance() const override { return false; }

 private:
  struct Traced {
    LensRay ray;  ///< leaves the front
    double weight;
  };
  /// Nothing when the lens stops it.
  std::optional<Traced> trace(double x, double y, Point2f lens) const;

  Params params_;
  LensSystem lens_;
  Vec3d filmSize_;  ///< metres; z: 0
  ExitPupil pupil_;
};

}  // namespace pbrtmedia
