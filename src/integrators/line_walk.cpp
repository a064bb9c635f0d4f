// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/line_walk.h"

namespace pbrtmedia {
namespace {

/// Crossings are remembered over this share of the coordinates: a line through a common edge of two triangles
/// may hit both, some roundings apart, and the accelerator must see that it is one crossing.
constexpr float kRemembered = 1e-4f;

}  // namespace

/// Forgets crossings that lie behind `t`. What the ray starts or ends on stays left out: another query would
/// report it at a t that rounding decides.
void LineWalk::forgetBefore(float t) {
  Exclusions kept = fixed_;
  for (const Exclusions::Entry& e : exclusions_.entries().subspan(fixed_.entries().size())) {
    if (e.t >= t) kept.add(e.id, e.t);
  }
  exclusions_ = kept;
}

void LineWalk::advancePast(const RayHit& hit) {
  tMin_ = hit.t;
  forgetBefore(tMin_ - kRemembered * (tMin_ + maxComponent(abs(ray_.o))));
  if (exclusions_.add(hit.id, hit.t)) return;
  forgetBefore(tMin_);
  if (exclusions_.add(hit.id, hit.t)) return;
  // More coincident surfaces than can be left out one by one: the others at this very t are passed over.
  tMin_ = std::nextafter(hit.t, kInfinity);
  exclusions_ = fixed_;
  exclusions_.add(hit.id, hit.t);
}

}  // namespace pbrtmedia
