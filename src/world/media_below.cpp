// SPDX-License-Identifier: BSD-2-Clause
#include "world/media_below.h"

namespace pbrtmedia {

void passMediaBelow(const MediaWalk::Context& context, MediumState& state, const SubsurfaceEntry& entry,
                    const SubsurfaceEmergence& exit, float time) {
  const MediaTopology& media = *context.media;
  const SurfaceInteraction &in = entry.si, &out = exit.si;
  media.leaveSurface(state, entry.hit, in, entry.coincident, -faceForward(in.n, in.wo), context.counters,
                     context.mismatches);
  const Vector3f way = out.p - in.p;
  const float distance = length(way);
  if (distance > 0) {
    Ray ray;
    ray.o = in.p;
    ray.d = way / distance;
    ray.tMax = distance;
    ray.time = time;
    Exclusions ends = entry.coincident.startingWith(entry.hit.hit.id);
    ends.add(exit.hit.hit.id, distance);
    MediaWalk(context, state, LineWalk(context.scene, ray, ends)).crossAll();
  }
  SurfaceInteraction fromBelow = out;
  fromBelow.wo = -Vector3f(out.n);
  media.leaveSurface(state, exit.hit, fromBelow, {}, Vector3f(out.n), context.counters, context.mismatches);
}

}  // namespace pbrtmedia
