// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/line_walk.h"

namespace pbrtmedia {

/// Forgets crossings that lie behind tMin. What the ray starts or ends on stays left out: another query would
/// report it at a t that rounding decides.
void LineWalk::dropPassed() {
  Exclusions kept = fixed_;
  for (const Exclusions::Entry& e : exclusions_.entries().subspan(fixed_.entries().size())) {
    if (e.t >= tMin_) kept.add(e.id, e.t);
  }
  exclusions_ = kept;
}

void LineWalk::advancePast(const RayHit& hit) {
  // One float below t, as queries are strict: what coincides with this hit must still be found.
  tMin_ = std::max(tMin_, std::nextafter(hit.t, 0.0f));
  dropPassed();
  if (exclusions_.add(hit.id, hit.t)) return;
  // More coincident surfaces than can be left out one by one: the others at this very t are passed over.
  tMin_ = hit.t;
  exclusions_ = fixed_;
  exclusions_.add(hit.id, hit.t);
}

}  // namespace pbrtmedia
