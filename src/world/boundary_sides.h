// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "media/medium.h"
#include "world/medium_state.h"

namespace pbrtmedia {

/// Whether a medium is there whatever else is: the rules Add and Priority (OverlapRule). Null: no.
inline bool isPresent(const Medium* medium) {
  return medium != nullptr && medium->overlap().mode != OverlapRule::Mode::Boundary;
}

/// The two sides of a boundary as a ray meets them.
struct BoundarySides {
  PlacedMedium near, far;
  bool nearIsPresent, farIsPresent;  ///< of the rules Add and Priority

  BoundarySides(const SceneHit& hit, bool towardOutside)
      : near(towardOutside ? insideOf(hit) : outsideOf(hit)),
        far(towardOutside ? outsideOf(hit) : insideOf(hit)),
        nearIsPresent(isPresent(near.medium)),
        farIsPresent(isPresent(far.medium)) {}

  /// Whether a side says what the boundary medium is there. Where one side names a medium that is present
  /// whatever else is there, vacuum on the other side only means "nothing added".
  bool nearNamesBoundary() const { return !nearIsPresent && (near.medium || !farIsPresent); }
  bool farNamesBoundary() const { return !farIsPresent && (far.medium || !nearIsPresent); }

 private:
  static PlacedMedium insideOf(const SceneHit& hit) {
    const Medium* const m = hit.primitive->media.inside;
    return {m, m ? hit.insidePlacement : nullptr};
  }
  static PlacedMedium outsideOf(const SceneHit& hit) {
    const Medium* const m = hit.primitive->media.outside;
    return {m, m ? hit.outsidePlacement : nullptr};
  }
};

}  // namespace pbrtmedia
