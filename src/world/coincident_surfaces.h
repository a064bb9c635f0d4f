// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "world/scene.h"

namespace pbrtmedia {

/// The other surfaces with two different media that pass through the point where a path scatters on a
/// surface. The path meets none of them as a hit of its own: its next ray starts on them, and which of them
/// it crosses follows from the sides that it comes from and leaves to (MediaTopology::leaveSurface). A value
/// type.
class CoincidentSurfaces {
 public:
  struct Entry {
    SceneHit hit;
    Normal3f n;  ///< geometric, world space
    Point3f p;   ///< world
  };
  /// Leaves room among the Exclusions of a ray.
  static constexpr std::size_t kCapacity = 6;

  /// False when full.
  bool add(const Entry& entry) {
    if (entries_.size() == kCapacity) return false;
    entries_.push_back(entry);
    return true;
  }
  std::size_t size() const { return entries_.size(); }
  bool isEmpty() const { return entries_.empty(); }
  const Entry* begin() const { return entries_.data(); }
  const Entry* end() const { return entries_.data() + entries_.size(); }
  /// What a ray that starts on them and on `own` leaves out.
  Exclusions startingWith(PrimitiveId own) const {
    Exclusions start(own);
    for (const Entry& e : *this) start.add(e.hit.hit.id, 0);
    return start;
  }

 private:
  std::vector<Entry> entries_;  ///< hardly ever any: then nothing is allocated
};

}  // namespace pbrtmedia
