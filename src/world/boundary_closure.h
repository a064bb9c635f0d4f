// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "world/primitive.h"

namespace pbrtmedia {

/// Why a boundary is not the surface of a region that holds its inside medium.
enum class BoundaryFault {
  FacesInward,  ///< closed, but its normals point to where "inside" should be
  Disagrees,    ///< its faces close, but some point inward and some outward
  Open,         ///< has a border
  MayHaveHoles  ///< an alpha texture may cut holes
};

/// What is known of the boundaries of a scene from their shapes alone. Open meshes with the same two media
/// that are placed together count together: six squares can close a box. A hole that alpha cuts is no
/// boundary, and a surface whose alpha is 0 throughout is none at all; shadowalpha does not matter, as
/// boundaries are hits. Takes time and memory linear in the number of triangles.
class BoundaryClosure {
 public:
  /// `groups`: primitives that are placed together.
  explicit BoundaryClosure(const std::vector<std::vector<const Primitive*>>& groups);

  /// Whether the medium lies only within closed boundaries, so that no ray can be in it and meet no further
  /// surface. Not so when a boundary names it on its outside, or names it inside and has a fault.
  bool isConfined(const Medium* medium) const { return confined_.count(medium) > 0; }
  bool confinesNothing() const { return confined_.empty(); }
  bool hasFaults() const { return !faults_.empty(); }
  /// Nothing for boundaries without fault, and where several curved shapes may close one another, but
  /// FacesInward where all of those point to their middle.
  std::optional<BoundaryFault> faultOf(const Primitive& boundary) const;

 private:
  class Group;
  std::unordered_set<const Medium*> confined_;
  std::unordered_map<const Primitive*, BoundaryFault> faults_;
};

}  // namespace pbrtmedia
