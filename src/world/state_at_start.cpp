// SPDX-License-Identifier: BSD-2-Clause
#include "world/state_at_start.h"

#include <algorithm>

namespace pbrtmedia {

MediumState stateAtStart(const MediaTopology& media, const Ray& ray, const Exclusions& start,
                         RenderCounters& counters) {
  const Scene& scene = media.scene();
  const std::optional<SceneHit> first = scene.closest(ray, 0, start, counters.rays);
  const float half = first ? first->t() / 2 : std::max(1.0f, scene.largestCoordinate());
  return media.stateAt(ray.at(half), ray.time, counters);
}

}  // namespace pbrtmedia
