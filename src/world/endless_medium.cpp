// SPDX-License-Identifier: BSD-2-Clause
#include "world/endless_medium.h"

#include <map>

#include "base/rng.h"
#include "media/medium.h"
#include "world/media_walk.h"
#include "world/probe_directions.h"

namespace pbrtmedia {
namespace {

bool isUnbounded(const Medium& medium) {
  const Bounds3f b = medium.bounds();
  return !b.isEmpty() && maxComponent(b.diagonal()) == kInfinity;
}

/// The first medium of the state that swallows everything on the way to infinity.
const Medium* endlessOf(const MediumState& state, const Ray& ray, RenderCounters& counters) {
  for (std::size_t i = 0; i < state.activeCount(); ++i) {
    const Medium& medium = *state.active(i).medium;
    if (!isUnbounded(medium)) continue;
    Rng rng(0);
    if (medium.transmittance({ray.o, ray.d, 0, kInfinity}, rng, counters).isBlack()) return &medium;
  }
  return nullptr;
}

const Medium* endlessAlong(const MediaTopology& media, const Ray& ray) {
  RenderCounters counters;
  MediumState state = media.camera().state();
  const Scene& scene = media.scene();
  MediaWalk({scene, &media, counters, counters.rays}, state, LineWalk(scene, ray, Exclusions{})).crossAll();
  return endlessOf(state, ray, counters);
}

}  // namespace

const Medium* findEndlessMedium(const MediaTopology& media, Point3f origin, float time) {
  if (!media.hasMedia()) return nullptr;
  std::map<const Medium*, std::size_t> votes;
  for (const Vector3f direction : kProbeDirections) {
    Ray ray;
    ray.o = origin;
    ray.d = normalize(direction);
    ray.time = time;
    const Medium* found = endlessAlong(media, ray);
    if (++votes[found] > kProbeDirections.size() / 2) return found;
  }
  return nullptr;
}

}  // namespace pbrtmedia
