// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>

namespace pbrtmedia {

class Scene;

/// Bounds that are learned in common by scenes of which images are subtracted. Densities are cut to the
/// bounds in force, so sides with bounds of their own would differ by what those cut away, and reject other
/// null collisions: by more than the parameter does. All of them have the bounds of one scene, which learns
/// from the look-ups of all.
class SharedBounds {
 public:
  /// `scene`: the one that learns; outlives the object.
  explicit SharedBounds(const Scene& scene) : scene_(scene) {}
  /// Between passes: puts the bounds of the scene into force in another. Throws SceneError when that has
  /// other media that learn, or other super-voxels.
  void lendTo(const Scene& other) const;
  /// After a pass: what look-ups in the other have found is proposed in the scene.
  void takeBackFrom(const Scene& other) const;

 private:
  const Scene& scene_;
};

}  // namespace pbrtmedia
