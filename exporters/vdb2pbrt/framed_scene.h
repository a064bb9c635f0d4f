// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>

#include "base/bounds.h"
#include "base/vec.h"

namespace pbrtmedia {

/// Which way is up in the world of a volume: y in Houdini, EmberGen and Maya, z in Blender.
enum class UpAxis { Y, Z };

/// A camera that sees a whole box, from its front on the right and a little above. Right-handed world.
struct Framing {
  Vec3d eye, look, up;
  double fov = 30;                ///< degrees over the shorter side
  int width = 640, height = 480;  ///< pixels; the shape follows the box
  Vec3d right;                    ///< unit vector to the right of the picture, level
  Vec3d toCamera;                 ///< unit vector from the box to the camera, level
};

/// `box`: not empty, not flat in all directions; a flat one is seen as if it were a little thick.
Framing framed(const Bounds3d& box, UpAxis up);

struct SceneParams {
  std::string source;   ///< for the comment at the top
  std::string include;  ///< as the scene's text names it
  std::string image;    ///< to write
  Bounds3d box;         ///< of all media, in world space
  UpAxis up = UpAxis::Y;
  bool glows = false;  ///< then it is dusk: the volume is the key light
};

/// A scene with camera, key light, sky and ground around an include of vdb2pbrt, which pbrt renders as it
/// stands.
std::string framedScene(const SceneParams& params);

}  // namespace pbrtmedia
