// SPDX-License-Identifier: BSD-2-Clause
#include "world/visibility.h"

#include <vector>

#include "lights/light.h"
#include "spectrum/rgb.h"
#include "world/media_walk.h"

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
  Rgb transmittance(PixelStream random, RenderCounters& counters) {
    for (const Stretch& s : stretches_) {
      if (through_.isBlack()) break;
      through_ *= MediaStretch(s.state, ray_, s.tMin, s.tMax).transmittance(random, counters);
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

/// Calls emit(sample, seen from the stretch's start) for what `medium` emits on a stretch from `from` on.
template <class Emit>
void sampleEmissionOf(const PlacedMedium& medium, const MediaStretch& stretch, double from,
                      PixelStream random, RenderCounters& counters, const Emit& emit) {
  for (std::size_t i = 0; i < stretch.state().activeCount(); ++i) {
    if (!(stretch.state().active(i) == medium)) continue;
    const EmissionSamples found = stretch.sampleEmission(i, random, counters);
    for (const EmissionSamples::Sample& s : found) {
      if (s.t >= from) emit(s);
    }
  }
}

bool isActive(const PlacedMedium& medium, const MediumState& state) {
  for (std::size_t i = 0; i < state.activeCount(); ++i) {
    if (state.active(i) == medium) return true;
  }
  return false;
}

/// Walks along the shadow ray. Calls passes(stretch) for each of which something is passed, and
/// emits(stretch, where on it the span begins, what is let through to its start) where the medium is present
/// inside the span.
template <class Passes, class Emits>
void walkToEmission(const MediaWalk::Context& context, const ShadowRay& shadow, const PlacedMedium& medium,
                    Span<double> span, MediumState& state, PixelStream random, const Passes& passes,
                    const Emits& emits) {
  MediaWalk walk(context, state, LineWalk(context.scene, shadow.ray, shadow.exclusions), shadow.from);
  const Ray& ray = walk.ray();
  PassedStretches passed(ray);
  const auto pass = [&](double tMin, double tMax) {
    passed.add(state, tMin, tMax);
    if (!state.isVacuum() && tMin < tMax) passes(MediaStretch(state, ray, tMin, tMax));
  };
  while (walk.t() < span.tMax) {
    walk.ahead();
    double t = walk.t();
    const double from = std::max(t, span.tMin), to = std::min(walk.tEnd(), span.tMax);
    if (from < to && isActive(medium, state)) {
      // Where what two parts let through is not what the whole does, the stretch must not be cut.
      const double start = state.isExponential() ? from : t;
      pass(t, start);
      const Rgb through = passed.transmittance(random, context.counters);
      if (through.isBlack()) return;
      emits(MediaStretch(state, ray, start, to), from, through);
      t = start;
    }
    pass(t, walk.tEnd());
    const std::optional<SceneHit> hit = walk.next();
    if (!hit || hit->primitive->material) return;
    walk.cross(*hit);
  }
}

}  // namespace

Rgb shadowEmission(const MediaWalk::Context& context, const ShadowRay& shadow, const PlacedMedium& medium,
                   Span<double> span, MediumState state, PixelStream random) {
  Rgb sum;
  walkToEmission(
      context, shadow, medium, span, state, random, [](const MediaStretch&) {},
      [&](const MediaStretch& stretch, double from, Rgb through) {
        Rgb emitted;
        sampleEmissionOf(medium, stretch, from, random, context.counters,
                         [&](const EmissionSamples::Sample& s) { emitted += s.radiance; });
        sum += through * emitted;
      });
  return sum;
}

void visitShadowEmission(const MediaWalk::Context& context, const ShadowRay& shadow,
                         const PlacedMedium& medium, Span<double> span, MediumState state, PixelStream random,
                         const std::function<void(const EmissionOnWay&)>& visit) {
  Rgb depth;
  walkToEmission(
      context, shadow, medium, span, state, random,
      [&](const MediaStretch& passed) { depth += passed.control().depth; },
      [&](const MediaStretch& stretch, double from, Rgb through) {
        sampleEmissionOf(medium, stretch, from, random, context.counters,
                         [&](const EmissionSamples::Sample& s) {
                           visit({s.t, through * s.radiance, depth + stretch.upTo(s.t).control().depth});
                         });
      });
}

/// Walks along a shadow ray. `pass(stretch)`: goes through a stretch of media, and tells whether anything is
/// left. False: nothing is left, or something is in the way.
template <class Pass>
static bool walkToLight(const MediaWalk::Context& context, const ShadowRay& shadow, MediumState& state,
                        const Pass& pass) {
  MediaWalk walk(context, state, LineWalk(context.scene, shadow.ray, shadow.exclusions), shadow.from);
  const auto blocks = [&](const SceneHit& h) { return h.primitive->material || h.isHider(shadow.hider); };
  for (;;) {
    const SceneHit* const nearest = walk.ahead();
    if (nearest && blocks(*nearest)) return false;
    if (!state.isVacuum() && !pass(walk.stretch())) return false;
    const std::optional<SceneHit> hit = walk.next();
    if (!hit) return true;
    if (blocks(*hit)) return false;
    walk.cross(*hit);
  }
}

Rgb shadowTransmittance(const MediaWalk::Context& context, const ShadowRay& shadow, MediumState& state,
                        PixelStream random) {
  Rgb product(1.0f);
  const bool arrives = walkToLight(context, shadow, state, [&](const MediaStretch& stretch) {
    product *= stretch.transmittance(random, context.counters);
    return !product.isBlack();
  });
  return arrives ? product : Rgb();
}

ControlledTransmittance controlledShadowTransmittance(const MediaWalk::Context& context,
                                                      const ShadowRay& shadow, MediumState& state,
                                                      PixelStream random) {
  ControlledTransmittance through{Rgb(1.0f), Rgb()};
  const bool arrives = walkToLight(context, shadow, state, [&](const MediaStretch& stretch) {
    through.value *= stretch.transmittance(random, context.counters);
    through.controlDepth += stretch.control().depth;
    return !through.value.isBlack();
  });
  return arrives ? through : ControlledTransmittance();
}

void dimByShadow(const MediaWalk::Context& context, const ShadowRay& shadow, MediumState& state,
                 PixelStream random, std::span<PairedTransmittance> estimates) {
  const bool arrives = walkToLight(context, shadow, state, [&](const MediaStretch& stretch) {
    bool isLeft = false;
    for (PairedTransmittance& estimate : estimates) {
      if (estimate.isBlack()) continue;
      estimate *= stretch.pairedTransmittance(random, context.counters);
      isLeft |= !estimate.isBlack();
    }
    return isLeft;
  });
  if (arrives) return;
  for (PairedTransmittance& estimate : estimates) estimate = {Rgb(), Rgb()};
}

}  // namespace pbrtmedia
