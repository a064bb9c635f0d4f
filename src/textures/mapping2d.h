// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <variant>

#include "base/transform.h"
#include "base/vec.h"
#include "shapes/surface_interaction.h"

namespace pbrtmedia {

/// A point of a 2D texture with its change per pixel step; all zero derivatives: no footprint known.
struct TexCoord2 {
  Point2f st;
  Vector2f dstdx, dstdy;
};

/// s = uScale u + uDelta, t = vScale v + vDelta.
struct UvMapping {
  float uScale = 1, vScale = 1, uDelta = 0, vDelta = 0;
  TexCoord2 operator()(const SurfaceInteraction& si) const;
};

/// s = θ/π from +z, t = φ/2π in [0, 1), of the direction of CTM⁻¹ p. The footprint is the exact derivative,
/// in t at most half a turn (all of the pole).
class SphericalMapping {
 public:
  /// `ctm`: texture to world, as in force at the Texture directive.
  explicit SphericalMapping(const Transform& ctm) : textureFromWorld_(ctm.inverseMatrix()) {}
  TexCoord2 operator()(const SurfaceInteraction& si) const;

 private:
  Affine3f textureFromWorld_;
};

/// s = (π + φ)/2π with φ in (-π, π], t = the z of the *normalised* CTM⁻¹ p, as in PBRT-v3: not a height.
class CylindricalMapping {
 public:
  explicit CylindricalMapping(const Transform& ctm) : textureFromWorld_(ctm.inverseMatrix()) {}
  TexCoord2 operator()(const SurfaceInteraction& si) const;

 private:
  Affine3f textureFromWorld_;
};

/// s = uDelta + p·v1, t = vDelta + p·v2, p in world space; the CTM plays no part.
struct PlanarMapping {
  Vector3f v1{1, 0, 0}, v2{0, 1, 0};
  float uDelta = 0, vDelta = 0;
  TexCoord2 operator()(const SurfaceInteraction& si) const;
};

/// From a surface point to a point of a 2D texture (scene-language reference 14.1).
using Mapping2d = std::variant<UvMapping, SphericalMapping, CylindricalMapping, PlanarMapping>;

inline TexCoord2 mapPoint(const Mapping2d& mapping, const SurfaceInteraction& si) {
  return std::visit([&si](const auto& m) { return m(si); }, mapping);
}

}  // namespace pbrtmedia
