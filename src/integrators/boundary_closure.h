// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <unordered_set>

#include "integrators/scene.h"

namespace pbrtmedia {

/// The media that lie only within closed boundaries, so that no ray can be in them and meet no further
/// surface. A medium is not confined when a boundary names it on its outside, or names it inside but is open
/// or faces inward. Open meshes with the same two media count together: six squares can close a box.
std::unordered_set<const Medium*> findConfinedMedia(const Scene& scene);

}  // namespace pbrtmedia
