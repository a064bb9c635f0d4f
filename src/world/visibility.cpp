// SPDX-License-Identifier: BSD-2-Clause
#include "world/visibility.h"

#include <vector>

#include "world/line_walk.h"

namespace pbrtmedia {

/// A shadow ray stops short of the light's surface by this share of its length, some roundings of a hit's t,
/// so that neighbours of the emitting primitive in its own plane do not shadow it.
static constexpr float kEndMargin = 0x1p-18f;

ShadowRay shadowRayTo(const Scene& scene, std::size_t light, const LightSample& sample, Point3f p, float time,
                      const Exclusions& start) {
  ShadowRay shadow;
  shadow.ray.o = p;
  shadow.ray.d = sample.wi;
  shadow.ray.time = time;
  shadow.ray.tMax = sample.distance * (1 - kEndMargin);
  shadow.exclusions = start;
  shadow.exclusions.add(scene.lightTarget(light), sample.distance);
  shadow.hider = scene.hiderOf(light);
  return shadow;
}

namespace {

/// Stretches that a shadow ray has passed but not yet been dimmed by: that is only worth its look-ups when
/// something emits behind them.
class PassedStretches {
 public:
  explicit PassedStretches(const Ray& ray) : ray_(ray) {}
  void add(const MediumState& state, double tMin, double tMax) {
    if (!state.isVacuum() && tMin < tMax) stretches_.push_back({state, tMin, tMax});
  }
  /// What they let through.
  Rgb transmittance(Rng& rng, RenderCounters& counters) {
    for (const Stretch& s : stretches_) {
      if (through_.isBlack()) break;
      through_ *= MediaTracker::transmittance(s.state, ray_, s.tMin, s.tMax, rng, counters);
    }
    stretches_.clear();
    return through_;
  }

 private:
  struct Stretch {
    MediumState state;
    double tMin, tMax;
  };
  const Ray& ray_;
  std::vector<Stretch> stretches_;
  Rgb through_{1.0f};
};

/// The emission of `medium` on a stretch in `state`, seen from the stretch's start.
Rgb emissionOf(const PlacedMedium& medium, const MediumState& state, const Ray& ray, double tMin, double tMax,
               Rng& rng, RenderCounters& counters) {
  Rgb sum;
  for (std::size_t i = 0; i < state.activeCount(); ++i) {
    if (!(state.active(i) == medium)) continue;
    const EmissionSamples found = MediaTracker::sampleEmission(state, i, ray, tMin, tMax, rng, counters);
    for (const EmissionSamples::Sample& s : found) sum += s.radiance;
  }
  return sum;
}

bool isActive(const PlacedMedium& medium, const MediumState& state) {
  for (std::size_t i = 0; i < state.activeCount(); ++i) {
    if (state.active(i) == medium) return true;
  }
  return false;
}

}  // namespace

Rgb shadowEmission(const Scene& scene, const MediaTracker& tracker, const ShadowRay& shadow,
                   const PlacedMedium& medium, Span<double> span, MediumState state, Rng& rng,
                   RenderCounters& counters, MismatchLog* log) {
  const Ray& ray = shadow.ray;
  LineWalk walk(scene, ray, shadow.exclusions);
  PassedStretches passed(ray);
  Rgb sum;
  double t = 0;
  const auto fits = [&](const SceneHit& h) { return tracker.fits(state, h, scene.surface(h, ray), ray.d); };
  while (t < span.tMax) {
    const std::optional<SceneHit> nearest = walk.peek(counters.shadowRays);
    const double tEnd = std::max<double>(t, nearest ? nearest->t() : ray.tMax);
    const double from = std::max(t, span.tMin), to = std::min(tEnd, span.tMax);
    if (from < to && isActive(medium, state)) {
      passed.add(state, t, from);
      const Rgb through = passed.transmittance(rng, counters);
      if (through.isBlack()) return sum;
      sum += through * emissionOf(medium, state, ray, from, to, rng, counters);
      t = from;
    }
    passed.add(state, t, tEnd);
    const std::optional<SceneHit> hit = walk.next(counters.shadowRays, fits);
    if (!hit || hit->primitive->material) return sum;
    if (!hit->primitive->media.same()) {
      tracker.cross(state, *hit, scene.surface(*hit, ray), ray.d, counters, log);
    }
    t = tEnd;
  }
  return sum;
}

Rgb shadowTransmittance(const Scene& scene, const MediaTracker& tracker, const ShadowRay& shadow,
                        MediumState& state, Rng& rng, RenderCounters& counters, MismatchLog* log) {
  const Ray& ray = shadow.ray;
  LineWalk walk(scene, ray, shadow.exclusions);
  Rgb product(1.0f);
  double t = 0;
  const auto fits = [&](const SceneHit& h) { return tracker.fits(state, h, scene.surface(h, ray), ray.d); };
  const auto blocks = [&](const SceneHit& h) { return h.primitive->material || h.isHider(shadow.hider); };
  for (;;) {
    const std::optional<SceneHit> nearest = walk.peek(counters.shadowRays);
    if (nearest && blocks(*nearest)) return {};
    if (!nearest && ray.tMax == kInfinity) tracker.escape(state, counters);
    const double tEnd = std::max<double>(t, nearest ? nearest->t() : ray.tMax);
    if (!state.isVacuum()) {
      product *= MediaTracker::transmittance(state, ray, t, tEnd, rng, counters);
      if (product.isBlack()) return product;
    }
    const std::optional<SceneHit> hit = walk.next(counters.shadowRays, fits);
    if (!hit) return product;
    if (blocks(*hit)) return {};
    if (!hit->primitive->media.same()) {
      tracker.cross(state, *hit, scene.surface(*hit, ray), ray.d, counters, log);
    }
    t = tEnd;
  }
}

}  // namespace pbrtmedia
