// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/visibility.h"

#include "integrators/line_walk.h"

namespace pbrtmedia {

/// A shadow ray stops short of the light's surface by this share of its length, some roundings of a hit's t,
/// so that neighbours of the emitting primitive in its own plane do not shadow it.
static constexpr float kEndMargin = 0x1p-18f;

ShadowRay shadowRayTo(const LightSample& sample, Point3f p, float time, PrimitiveId start,
                      PrimitiveId target) {
  ShadowRay shadow;
  shadow.ray.o = p;
  shadow.ray.d = sample.wi;
  shadow.ray.time = time;
  shadow.ray.tMax = sample.distance * (1 - kEndMargin);
  shadow.exclusions.add(start, 0);
  shadow.exclusions.add(target, sample.distance);
  return shadow;
}

Rgb shadowTransmittance(const Scene& scene, const MediaTracker& tracker, const ShadowRay& shadow,
                        MediumState& state, Rng& rng, RenderCounters& counters, MismatchLog* log) {
  const Ray& ray = shadow.ray;
  LineWalk walk(scene, ray, shadow.exclusions);
  Rgb product(1.0f);
  double t = 0;
  const auto fits = [&](const SceneHit& h) { return tracker.fits(state, h, scene.surface(h, ray), ray.d); };
  for (;;) {
    const std::optional<SceneHit> nearest = walk.peek(counters.shadowRays);
    if (nearest && nearest->primitive->material) return {};
    if (!nearest && ray.tMax == kInfinity) tracker.escape(state, counters);
    const double tEnd = std::max<double>(t, nearest ? nearest->t() : ray.tMax);
    if (!state.isVacuum()) {
      product *= MediaTracker::transmittance(state, ray, t, tEnd, rng, counters);
      if (product.isBlack()) return product;
    }
    const std::optional<SceneHit> hit = walk.next(counters.shadowRays, fits);
    if (!hit) return product;
    if (hit->primitive->material) return {};
    if (!hit->primitive->media.same()) {
      tracker.cross(state, *hit, scene.surface(*hit, ray), ray.d, counters, log);
    }
    t = tEnd;
  }
}

}  // namespace pbrtmedia
