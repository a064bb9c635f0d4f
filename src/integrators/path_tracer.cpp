// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/path_tracer.h"

#include "base/warp.h"
#include "integrators/medium_light.h"

namespace pbrtmedia {
namespace {

/// PBRT-v3's roulette: from this bounce on, with at least this chance of ending (scene-language
/// reference 11.2).
constexpr int kRouletteBounces = 3;
constexpr float kLeastTermination = 0.05f;
/// In media, paths of less weight than this are already thinned out before that bounce. What is left of such
/// a path has little part in the variance, and an absorbing medium costs hardly more than two scatterings.
constexpr float kMediumRouletteWeight = 0.03f;

/// Channels whose extinctions differ by more than this factor are followed one by one. Three paths cost 2 to
/// 2.6 times one; the variance of one reaches that at factors of 2.5 to 4 (cubes of optical depth 2 to 40).
constexpr float kSplitFactor = 3;

BoundaryPlane planeAt(const SurfaceInteraction& si, Vector3f toward) {
  return {true, si.p, faceForward(si.n, toward)};
}

/// Whether sampling the BSDF reaches every direction in which it scatters. With a shading normal, or glossy
/// lobes, some can be reached by light samples only.
bool samplingCoversBsdf(const Bsdf& bsdf, const SurfaceInteraction& si) {
  constexpr BsdfFlags kDiffuse = BsdfFlags::Diffuse | BsdfFlags::Reflection | BsdfFlags::Transmission;
  return bsdf.count(kDiffuse) == bsdf.count() && bsdf.shadingNormal() == si.n;
}

}  // namespace

PathTracer::PathTracer(const PathSetup& setup, const RayDifferential& ray, const MediumState& start,
                       SampleContext& context)
    : setup_(setup),
      context_(context),
      samples_(context),
      counters_(context.counters),
      ray_(ray),
      state_(start) {}

Rgb PathTracer::trace() { return finish(travel()); }

Rgb PathTracer::finish(Event event) {
  for (;; event = travel()) {
    switch (event) {
      case Event::End:
        return radiance_;
      case Event::Surface:
        if (!scatterOnSurface()) return radiance_;
        break;
      case Event::Medium:
        if (!scatterInMedium()) return radiance_;
        break;
    }
  }
}

/// Follows the ray through boundaries without material to the next scattering event, and collects what emits
/// on the way. Crossings cost no depth and no roulette.
PathTracer::Event PathTracer::travel() {
  if (seesOnlyEmission() && !setup_.scene.hasVisibleEmitters() && !setup_.mediaEmit) return Event::End;
  Travel way{LineWalk(setup_.scene, ray_, Exclusions(rayStart_)), startPlane_};
  return travelOn(way);
}

PathTracer::Event PathTracer::travelOn(Travel& way) {
  auto& [walk, start, t] = way;
  const auto fits = [&](const SceneHit& h) {
    return !setup_.media || setup_.media->fits(state_, h, setup_.scene.surface(h, ray_), ray_.d);
  };
  for (;;) {
    const std::optional<SceneHit> nearest = walk.peek(counters_.rays);
    const double tEnd = nearest ? std::max<double>(t, nearest->t()) : kInfinity;
    if (!nearest && setup_.media) setup_.media->escape(state_, counters_);
    if (seesOnlyEmission()) {
      const bool blocked = nearest && nearest->primitive->material && !nearest->isEmitter();
      if (blocked || (!nearest && setup_.scene.infiniteLights().empty())) {
        if (setup_.mediaEmit) collectMediumEmission(t, tEnd);
        return Event::End;
      }
    }
    if (!state_.isVacuum()) {
      Event event = Event::End;
      if (!passMedium(way, tEnd, nearest ? &*nearest : nullptr, event)) return event;
    }
    const std::optional<SceneHit> hit = walk.next(counters_.rays, fits);
    if (!hit) {
      collectBackground();
      return Event::End;
    }
    const bool scatters = hit->primitive->material != nullptr;
    if (scatters || hit->isEmitter() || setup_.media) {
      const SurfaceInteraction si = surfaceAt(*hit);
      if (hit->isEmitter()) collectEmission(*hit, si);
      if (scatters) {
        if (seesOnlyEmission()) return Event::End;
        surface_ = {*hit, si};
        return Event::Surface;
      }
      if (setup_.media) {
        setup_.media->cross(state_, *hit, si, ray_.d, counters_, context_.mismatches);
        start = planeAt(si, ray_.d);
      }
    }
    t = tEnd;
  }
}

/// The media between two surfaces. True: the path passes. False: `event` tells whether it scatters or ends.
bool PathTracer::passMedium(const Travel& way, double tMax, const SceneHit* hit, Event& event) {
  if (!seesOnlyEmission() && splitsChannels()) {
    followChannels(way);
    event = Event::End;
    return false;
  }
  const double tMin = way.t;
  const BoundaryPlane& start = way.start;
  if (setup_.mediaEmit) collectMediumEmission(tMin, tMax);
  if (seesOnlyEmission()) {
    beta_ *= MediaTracker::transmittance(state_, ray_, tMin, tMax, context_.rng, counters_);
    return !beta_.isBlack();
  }
  std::optional<double> extinction;
  // Under another law, what a stretch scatters is not extinction times transmittance.
  const bool lightsStretch = setup_.positionLights && MediaTracker::isExponential(state_);
  if (lightsStretch) {
    // Media of nothing take no sample: their boundaries leave the image as it is, bit for bit.
    const double mean = MediaTracker::meanExtinction(state_, ray_, tMin, tMax);
    if (setup_.params.mediumLightSampling == MediumLightSampling::Auto) extinction = mean;
    if (mean > 0) lightStretch({ray_, tMin, tMax, extinction}, hit, start);
  }
  const MediumFlight flight =
      MediaTracker::sampleFreeFlight(state_, ray_, tMin, tMax, beta_, context_.rng, counters_);
  beta_ *= flight.weight;
  if (beta_.isBlack()) return false;
  // A path that media have dimmed on its way has little part in the variance. What is seen directly stays
  // exact.
  if (!flight.collided) return flight.weight == Rgb(1.0f) || bounces_ == 0 || playRoulette(/*inMedium=*/true);
  medium_ = {
      mediumPoint(flight.t, tMax, hit, start), flight.phase, flight.t, tMin, tMax, extinction, lightsStretch};
  if (!isFinite(medium_.p)) return false;  // beyond what coordinates can tell: nothing is out there
  event = Event::Medium;
  return false;
}

/// Whether from here on each channel is better followed alone: a path that all share weighs them by the mean
/// of their densities, and in each the weights vary the more the further apart extinctions are.
bool PathTracer::splitsChannels() const {
  if (setup_.params.channelSampling == ChannelSampling::Shared) return false;
  if ((beta_.r != 0) + (beta_.g != 0) + (beta_.b != 0) < 2) return false;
  const float factor = setup_.params.channelSampling == ChannelSampling::Split ? 1 : kSplitFactor;
  for (std::size_t i = 0; i < state_.activeCount(); ++i) {
    const Rgb sigmaT = state_.active(i).medium->sigmaT();
    float least = kInfinity, most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      if (beta_[c] == 0) continue;
      least = std::min(least, sigmaT[c]);
      most = std::max(most, sigmaT[c]);
    }
    if (most > factor * least) return true;
  }
  return false;
}

/// The rest of the path once for each channel. A channel alone is what free flights choose distances for, as
/// they are told its throughput.
void PathTracer::followChannels(const Travel& way) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (beta_[c] == 0) continue;
    PathTracer one(*this);
    one.radiance_ = Rgb();
    one.beta_ = Rgb();
    one.beta_[c] = beta_[c];
    Travel rest{LineWalk(way.walk, one.ray_), way.start, way.t};
    radiance_ += one.finish(one.travelOn(rest));
  }
}

/// The point at `t` of a stretch that ends at tMax with `hit`, on the right side of the boundaries.
Point3f PathTracer::mediumPoint(double t, double tMax, const SceneHit* hit, const BoundaryPlane& start) {
  BoundaryPlane end;
  if (hit && tMax - t < MediaTracker::kNearBoundary * (tMax + maxComponent(abs(ray_.o)))) {
    end = planeAt(setup_.scene.surface(*hit, ray_), -ray_.d);
  }
  return MediaTracker::scatterPoint(ray_, t, start, end, counters_);
}

/// Single scattering of a light at one point, at a distance chosen for that light. The flight that follows
/// may collide and sample the same light: `collisionShare` divides the work.
void PathTracer::lightStretch(const PositionLights::Stretch& stretch, const SceneHit* hit,
                              const BoundaryPlane& start) {
  const float u = samples_.get1D(), v = samples_.get1D();
  const auto choice = setup_.positionLights->sample(stretch, u, v);
  if (!choice) return;
  const Point3f p = mediumPoint(choice->t, stretch.tMax, hit, start);
  if (!isFinite(p)) return;
  const PickedLight light{choice->light, setup_.lights[choice->light]->sample(p, {})};
  const LightSample& s = light.sample;
  if (!(s.pdf > 0) || s.radiance.isBlack()) return;
  const Rgb scattered = MediaTracker::scattering(state_, ray_, choice->t, -ray_.d, s.wi, counters_);
  if (scattered.isBlack()) return;
  double density = choice->pdf;
  if (setup_.params.mediumLightSampling == MediumLightSampling::Mis) {
    density += MediaTracker::flightDensity(state_, ray_, stretch.tMin, choice->t) *
               double{setup_.selector->probability(p, choice->light)};
  }
  const Rgb through =
      MediaTracker::transmittance(state_, ray_, stretch.tMin, choice->t, context_.rng, counters_);
  if (through.isBlack()) return;
  radiance_ += beta_ * through * scattered * s.radiance * static_cast<float>(1 / density) *
               unoccluded(light, p, {}, state_);
}

/// What the media emit between two surfaces, at one distance for each that does.
void PathTracer::collectMediumEmission(double tMin, double tMax) {
  for (std::size_t i = 0; i < state_.activeCount(); ++i) {
    const PlacedMedium m = state_.active(i);
    if (!m.medium->isEmissive()) continue;
    const EmissionDistance e =
        MediaTracker::sampleEmission(state_, i, ray_, tMin, tMax, context_.rng, counters_);
    if (!(e.pdf > 0) || e.emission.isBlack()) continue;
    const Rgb through = MediaTracker::transmittance(state_, ray_, tMin, e.t, context_.rng, counters_);
    radiance_ += beta_ * through * e.emission * static_cast<float>(1 / e.pdf) * mediumEmissionWeight(m, e.t);
  }
}

SurfaceInteraction PathTracer::surfaceAt(const SceneHit& hit) const {
  SurfaceInteraction si = setup_.scene.surface(hit, ray_);
  if (ray_.hasDifferentials && hit.primitive->material) si.computeDifferentials(ray_);
  return si;
}

/// Share of the emission found by the current segment; light sampling at its start accounts for the rest.
float PathTracer::emissionWeight(std::size_t light, const SurfaceInteraction* si) const {
  if (isDirect_) return 1;
  if (light == SceneHit::kNoLight) return 0;  // visible, but no source of illumination
  const Light& source = *setup_.lights[light];
  if (ownsUniformLights_ && source.isUniformInfinite()) return 1;
  const float lightPdf = setup_.selector->probability(ray_.o, light) * source.pdf(ray_.o, ray_.d, si);
  return powerHeuristic(directionPdf_, lightPdf);
}

/// The same for emission that a medium shows at `t` of the segment.
float PathTracer::mediumEmissionWeight(const PlacedMedium& medium, double t) const {
  if (isDirect_) return 1;
  const std::optional<std::size_t> light = setup_.scene.lightOf(medium);
  if (!light) return 1;
  const MediumLight& source = *setup_.scene.mediumLight(*light);
  const double lightPdf =
      double{setup_.selector->probability(ray_.o, *light)} * source.pdfAt(ray_.o, ray_.d, t, ray_.time);
  if (!(lightPdf > 0)) return 1;  // outside of what light samples look at
  return powerHeuristic(static_cast<float>(directionPdf_ * source.distancePdf(ray_.o, ray_.d, t, ray_.time)),
                        static_cast<float>(lightPdf));
}

void PathTracer::collectEmission(const SceneHit& hit, const SurfaceInteraction& si) {
  const Rgb emitted = hit.areaLight().emitted(si.n, si.wo);
  if (!emitted.isBlack()) radiance_ += beta_ * emitted * emissionWeight(hit.light, &si);
}

void PathTracer::collectBackground() {
  for (const std::uint32_t light : setup_.scene.infiniteLights()) {
    const Rgb background = setup_.lights[light]->background(ray_.d);
    if (!background.isBlack()) radiance_ += beta_ * background * emissionWeight(light, nullptr);
  }
}

bool PathTracer::scatterOnSurface() {
  ++counters_.surfaceScatterings;
  samples_.startVertex(bounces_);
  SurfaceInteraction& si = surface_.si;
  const Bsdf bsdf = surface_.hit.primitive->material->bsdf(si, /*mergeSpecular=*/true);
  ownsUniformLights_ = samplingCoversBsdf(bsdf, si);
  if (bsdf.count(BsdfFlags::AllButSpecular) > 0) lightSurface(bsdf);

  const BsdfSample sample = bsdf.sample(si.wo, samples_.get2D());
  if (!(sample.pdf > 0) || sample.f.isBlack()) return false;
  beta_ *= sample.f * (absDot(sample.wi, bsdf.shadingNormal()) / sample.pdf);
  if (beta_.isBlack()) return false;
  isDirect_ = any(sample.flags & BsdfFlags::Specular);
  directionPdf_ = sample.pdf;
  if (isDirect_ && any(sample.flags & BsdfFlags::Transmission) &&
      dot(sample.wi, si.n) * dot(si.wo, si.n) < 0) {
    const float eta2 = sqr(bsdf.eta());
    etaScale_ *= dot(si.wo, si.n) > 0 ? eta2 : 1 / eta2;
  }
  ++bounces_;
  if (setup_.media) {
    setup_.media->leaveSurface(state_, surface_.hit, si, sample.wi, counters_, context_.mismatches);
  }
  startSegment(si.p, sample.wi, planeAt(si, sample.wi), surface_.hit.hit.id);
  return playRoulette(/*inMedium=*/false);
}

bool PathTracer::scatterInMedium() {
  ++counters_.mediumScatterings;
  samples_.startVertex(bounces_);
  // A phase function samples a uniform light perfectly, but not what dims it on the way: where light sampling
  // adds a second, independent look through the medium, it pays (variance and time change by like factors).
  ownsUniformLights_ = false;
  lightMedium();
  const PhaseFunction::Sample sample = medium_.phase->sample(-ray_.d, samples_.get2D());
  if (!(sample.value > 0)) return false;
  isDirect_ = false;
  directionPdf_ = sample.value;
  ++bounces_;
  startSegment(medium_.p, sample.wi, {}, {});
  return playRoulette(/*inMedium=*/true);
}

void PathTracer::startSegment(Point3f o, Vector3f d, const BoundaryPlane& plane, PrimitiveId start) {
  const float time = ray_.time;
  ray_ = RayDifferential();
  ray_.o = o;
  ray_.d = d;
  ray_.time = time;
  startPlane_ = plane;
  rayStart_ = start;
}

/// A light and a point on it; nothing when light sampling has no part in the estimate.
std::optional<PathTracer::PickedLight> PathTracer::pickLight(Point3f p, bool scatteringFindsUniformLights) {
  const auto& lights = setup_.lights;
  if (lights.empty()) return std::nullopt;
  const auto skips = [&](std::size_t i) {
    return scatteringFindsUniformLights && lights[i]->isUniformInfinite();
  };
  if (lights.size() == 1 && skips(0)) return std::nullopt;
  const LightSelector::Choice choice = setup_.selector->choose(p, samples_.get1D());
  const Point2f u = samples_.get2D();
  if (skips(choice.light)) return std::nullopt;
  const MediumLight* const emitter = setup_.scene.mediumLight(choice.light);
  PickedLight picked{choice.light,
                     emitter ? emitter->sample(p, u, ray_.time) : lights[choice.light]->sample(p, u)};
  if (!(picked.sample.pdf > 0) || picked.sample.radiance.isBlack()) return std::nullopt;
  picked.sample.pdf *= choice.probability;
  return picked;
}

Rgb PathTracer::unoccluded(const PickedLight& light, Point3f p, PrimitiveId start, const MediumState& state) {
  const Scene& scene = setup_.scene;
  ShadowRay shadow = shadowRayTo(light.sample, p, ray_.time, start, scene.lightTarget(light.index));
  if (setup_.media) {
    const MediumLight* const emitter = scene.mediumLight(light.index);
    if (emitter) shadow.ray.tMax = light.sample.distance;
    MediumState end = state;
    const Rgb through =
        shadowTransmittance(scene, *setup_.media, shadow, end, context_.rng, counters_, context_.mismatches);
    if (!emitter || through.isBlack()) return through;
    // As often as the medium is there, as distances are sampled.
    float present = 0;
    for (std::size_t i = 0; i < end.activeCount(); ++i) {
      if (end.active(i) == emitter->medium()) ++present;
    }
    return through * present;
  }
  return Rgb(scene.occluded(shadow.ray, 0, shadow.exclusions, counters_.shadowRays) ? 0.0f : 1.0f);
}

/// Share of a light sample at `p`; what a direction of that density finds accounts for the rest.
float PathTracer::lightWeight(const PickedLight& light, Point3f p, float directionPdf) const {
  if (setup_.lights[light.index]->isDelta()) return 1;
  const LightSample& s = light.sample;
  if (const MediumLight* const emitter = setup_.scene.mediumLight(light.index)) {
    directionPdf *= static_cast<float>(emitter->distancePdf(p, s.wi, double{s.distance}, ray_.time));
  }
  return powerHeuristic(s.pdf, directionPdf);
}

/// Share of a collision's sample of a light at one point; `lightStretch` accounts for the rest.
float PathTracer::collisionShare(std::size_t light, Point3f p) const {
  if (!medium_.lightsStretch || !setup_.positionLights->contains(light)) return 1;
  const MediumLightSampling sampling = setup_.params.mediumLightSampling;
  if (sampling == MediumLightSampling::Equiangular) return 0;
  const double stretch =
      setup_.positionLights->pdf(light, {ray_, medium_.tMin, medium_.tMax, medium_.extinction}, medium_.t);
  if (!(stretch > 0)) return 1;
  if (sampling == MediumLightSampling::Auto) return 0;
  const double flight = MediaTracker::flightDensity(state_, ray_, medium_.tMin, medium_.t) *
                        double{setup_.selector->probability(p, light)};
  return static_cast<float>(flight / (flight + stretch));
}

void PathTracer::lightSurface(const Bsdf& bsdf) {
  const SurfaceInteraction& si = surface_.si;
  const std::optional<PickedLight> light = pickLight(si.p, ownsUniformLights_);
  if (!light) return;
  const LightSample& s = light->sample;
  const Rgb f = bsdf.f(si.wo, s.wi, BsdfFlags::AllButSpecular) * absDot(s.wi, bsdf.shadingNormal());
  if (f.isBlack()) return;
  const bool isDelta = setup_.lights[light->index]->isDelta();
  const float weight = isDelta ? 1 : lightWeight(*light, si.p, bsdf.pdf(si.wo, s.wi));
  MediumState state = state_;
  if (setup_.media) {
    setup_.media->leaveSurface(state, surface_.hit, si, s.wi, counters_, context_.mismatches);
  }
  radiance_ +=
      beta_ * f * s.radiance * (weight / s.pdf) * unoccluded(*light, si.p, surface_.hit.hit.id, state);
}

void PathTracer::lightMedium() {
  const std::optional<PickedLight> light = pickLight(medium_.p, ownsUniformLights_);
  if (!light) return;
  const LightSample& s = light->sample;
  const float phase = medium_.phase->evaluate(-ray_.d, s.wi);
  if (!(phase > 0)) return;
  const float weight = lightWeight(*light, medium_.p, phase) * collisionShare(light->index, medium_.p);
  if (!(weight > 0)) return;
  radiance_ += beta_ * s.radiance * (phase * weight / s.pdf) * unoccluded(*light, medium_.p, {}, state_);
}

bool PathTracer::playRoulette(bool inMedium) {
  const float threshold = setup_.params.rrThreshold;
  const float weight = std::max(std::abs(beta_.max()), std::abs(beta_.min())) * etaScale_;
  float survival = 1;
  if (bounces_ - 1 > kRouletteBounces) {
    if (weight < threshold) survival = std::min(weight, inMedium ? 1.0f : 1 - kLeastTermination);
  } else if (inMedium && weight < kMediumRouletteWeight * std::min(threshold, 1.0f)) {
    survival = weight / kMediumRouletteWeight;
  }
  if (survival >= 1) return true;
  if (context_.rng.uniform() >= survival) return false;
  beta_ /= survival;
  return true;
}

}  // namespace pbrtmedia
