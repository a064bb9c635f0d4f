// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/transform.h"
#include "base/vec.h"
#include "shapes/surface_interaction.h"

namespace pbrtmedia {

/// A point of a solid texture with its change per pixel step.
struct TexCoord3 {
  Point3f p;
  Vector3f dpdx, dpdy;
};

/// The point of a solid texture is CTM · p with p in world space: the *forward* matrix, as in PBRT-v3, so
/// `Scale 2 2 2` before such a texture makes its features half as large.
class Mapping3d {
 public:
  Mapping3d() = default;  ///< world space
  explicit Mapping3d(const Transform& ctm) : ctm_(ctm.matrix()) {}
  TexCoord3 operator()(const SurfaceInteraction& si) const {
    return {ctm_.point(si.p), ctm_.vector(si.dpdx), ctm_.vector(si.dpdy)};
  }

 private:
  Affine3f ctm_;
};

}  // namespace pbrtmedia
