// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "accelerators/accelerator.h"
#include "base/ray.h"
#include "base/transform.h"
#include "base/vec.h"

namespace pbrtmedia {

/// Everything local that a surface point knows, world space.
struct SurfaceInteraction {
  Point3f p;
  float time = 0;
  Vector3f wo;  ///< unit, toward where the ray came from
  Normal3f n;   ///< unit geometric normal after all orientation rules (scene-language reference 13.1)
  Point2f uv;
  Vector3f dpdu, dpdv;
  Normal3f dndu, dndv;  ///< as in PBRT-v3: of the normal before orientation, see transformInteraction
  struct Shading {
    Normal3f n;  ///< unit, on the side of the geometric normal
    Vector3f dpdu, dpdv;
    Normal3f dndu, dndv;
  } shading;
  /// Footprint for texture filtering; all zero when the ray carries no differentials.
  Vector3f dpdx, dpdy;
  float dudx = 0, dvdx = 0, dudy = 0, dvdy = 0;
  PrimitiveId primitive;
  std::uint32_t faceIndex = 0;
  /// A strand without thickness that faces whatever ray meets it: its normals are those of this ray alone.
  bool turnsToRays = false;

  /// Fills the footprint from the auxiliary rays: their hits with the tangent plane, then least squares in
  /// (u, v).
  void computeDifferentials(const RayDifferential& ray);
  /// Sets the shading frame; the normal is flipped to the side of `n`, or `n` to its side when
  /// `orientationIsAuthoritative` (meshes with N).
  void setShading(Normal3f ns, Vector3f dpdus, Vector3f dpdvs, Normal3f dndus, Normal3f dndvs,
                  bool orientationIsAuthoritative);
};

/// The interaction seen through a placement; `wo` is transformed too (and stays unit length). Derivatives of
/// normals are mapped as vectors across surfaces are, as in PBRT-v3: those of the unit normal where nothing
/// scales, times 1/s under a uniform scale s. Bump maps of existing scenes are made for it.
SurfaceInteraction transformInteraction(const Transform& worldFromObject, const SurfaceInteraction& si);

}  // namespace pbrtmedia
