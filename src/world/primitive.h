// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <vector>

#include "base/diagnostics.h"

namespace pbrtmedia {

class AreaLight;
class Material;
class Medium;
class Shape;
template <class T>
class Texture;
using FloatTexture = Texture<float>;

/// The media on the two sides of a surface; null: vacuum. Inside is the side opposite the geometric normal.
struct MediumInterface {
  const Medium* inside = nullptr;
  const Medium* outside = nullptr;
  /// Of primitives in an object: whether the medium moves with the object's placements (it was defined in the
  /// object), or stays in the world where it was defined.
  bool insideMoves = true, outsideMoves = true;
  /// Such a surface changes nothing: the ray keeps whatever medium it is in (scene-language reference 17.4).
  bool same() const { return inside == outside; }
};

/// One shape as the scene uses it. Everything is borrowed: SceneBuilder::own keeps it alive.
struct Primitive {
  const Shape* shape = nullptr;        ///< required
  const Material* material = nullptr;  ///< null: no material, the surface is passed straight through
  MediumInterface media{};
  const FloatTexture* alpha = nullptr;        ///< hits where it is exactly 0 do not exist; null: opaque
  const FloatTexture* shadowAlpha = nullptr;  ///< the same, for yes/no occlusion rays only
  /// One light for each of the shape's primitives, or none at all: the surface does not emit.
  std::vector<AreaLight*> areaLights{};
  SourceLocation location{};  ///< of the shape in the scene's text, for messages

  /// Passing through it can be ignored altogether.
  bool isInvisible() const { return !material && media.same() && areaLights.empty(); }
};

}  // namespace pbrtmedia
