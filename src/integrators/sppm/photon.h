// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/vec.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// A vertex of a light path.
struct Photon {
  Point3f p;        ///< world
  Vector3f wi;      ///< unit, toward where it comes from
  Rgb power;        ///< that arrives, for one light path instead of all
  int scatterings;  ///< before this one
};

/// One on a surface that scatters diffusely.
struct SurfacePhoton : Photon {
  float cosine;  ///< >= 0, of wi and the normal of the surface there, not that of shading
};

/// One in media: of its power, what is scattered.
struct MediumPhoton : Photon {
  Rgb sigmaS;  ///< scattering coefficient of the media there, 1/length
};

}  // namespace pbrtmedia
