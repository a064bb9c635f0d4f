// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/path/path_tracer.h"

#include "integrators/path/led_flight.h"
#include "materials/bsdf.h"
#include "materials/material.h"
#include "media/medium.h"
#include "media/phase/phase_function.h"
#include "spectrum/largest_channel.h"
#include "world/boundary_planes.h"
#include "world/media_below.h"
#include "world/subsurface_probe.h"

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

/// Flights on segments before the scattering of this number are led by stratified numbers.
constexpr int kLedBounces = 1;

}  // namespace

PathTracer::PathTracer(const PathSetup& setup, const RayDifferential& ray, const MediumState& start,
                       SampleContext& context, IndirectLight* indirect)
    : setup_(setup),
      context_(context),
      indirect_(indirect),
      samples_(context.sampler, context.rng),
      counters_(context.counters),
      ray_(ray),
      state_(start),
      lastVertex_(setup.params.maxDepth) {}

Rgb PathTracer::trace() {
  if (!context_.layers.isWanted()) return scatterFrom(flyToEvent());
  RayLayers layers(context_.layers);
  layers_ = &layers;
  const Rgb radiance = scatterFrom(flyToEvent());
  layers.finish();
  return radiance;
}

Rgb PathTracer::scatterFrom(PathEvent event) {
  for (;; event = flyToEvent()) {
    switch (event) {
      case PathEvent::End:
        return radiance_;
      case PathEvent::Surface:
        if (!scatterOnSurface()) return radiance_;
        break;
      case PathEvent::Medium:
        if (!scatterInMedium()) return radiance_;
        break;
    }
  }
}

/// Follows the ray through boundaries without material to the next scattering event, and collects what emits
/// on the way. Crossings cost no depth and no roulette.
PathEvent PathTracer::flyToEvent() {
  if (seesOnlyEmission() && !setup_.scene.hasVisibleEmitters() && !setup_.mediaEmit) return PathEvent::End;
  const bool isFromCamera = bounces_ == 0;
  Way way{{walkContext(), state_,
           isFromCamera ? LineWalk::fromCamera(setup_.scene, ray_) : LineWalk(setup_.scene, ray_, rayStart_),
           &from_},
          startPlane_};
  return followWay(way);
}

MediaWalk::Context PathTracer::walkContext() const {
  return {setup_.scene, setup_.media, counters_, counters_.rays, context_.mismatches};
}

MediaWalk::Context PathTracer::shadowContext() const {
  return {setup_.scene, setup_.media, counters_, counters_.shadowRays, context_.mismatches};
}

PathEvent PathTracer::followWay(Way& way) {
  MediaWalk& walk = way.walk;
  for (;;) {
    const SceneHit* const nearest = walk.ahead();
    if (seesOnlyEmission()) {
      const bool blocked = nearest && nearest->primitive->material && !nearest->isEmitter();
      if (blocked || (!nearest && setup_.scene.infiniteLights().empty())) {
        if (setup_.mediaEmit) collectMediumEmission({state_, ray_, walk.t(), walk.tEnd()});
        return PathEvent::End;
      }
    }
    if (!state_.isVacuum()) {
      PathEvent event = PathEvent::End;
      if (!passMedium(way, nearest, event)) return event;
    }
    const std::optional<SceneHit> hit = walk.next();
    if (!hit) {
      if (layers_ && bounces_ == 0) layers_->addEscape(beta_);
      collectBackground();
      return PathEvent::End;
    }
    const bool scatters = hit->primitive->material != nullptr;
    if (!scatters && !hit->isEmitter() && !setup_.media) {
      walk.cross(*hit);
      continue;
    }
    const SurfaceInteraction si = surfaceAt(*hit);
    if (hit->isEmitter()) collectEmission(way, *hit, si);
    if (scatters) {
      if (seesOnlyEmission()) return PathEvent::End;
      surface_ = {*hit, si, {}};
      if (setup_.media && setup_.scene.hasMediumBoundaries())
        surface_.coincident = walk.coincidentWith(*hit, si);
      return PathEvent::Surface;
    }
    if (setup_.media) {
      const Vec3d p = Vec3d(ray_.o) + walk.tEnd() * Vec3d(ray_.d);
      way.start = planeAt(*hit, si, p, ray_.d, ray_.time);
    }
    walk.cross(*hit, si);
  }
}

/// The media between two surfaces, `hit` the one at the end. True: the path passes. False: `event` tells
/// whether it scatters or ends.
bool PathTracer::passMedium(const Way& way, const SceneHit* hit, PathEvent& event) {
  if (!seesOnlyEmission() && splitsChannels()) {
    followChannels(way);
    event = PathEvent::End;
    return false;
  }
  const MediaStretch stretch(state_, ray_, way.walk.t(), way.walk.tEnd());
  const BoundaryPlane& start = way.start;
  if (setup_.mediaEmit) collectMediumEmission(stretch);
  if (seesOnlyEmission()) {
    beta_ *= stretch.transmittance(context_.stream(), counters_);
    return !beta_.isBlack();
  }
  const std::optional<LitStretch> lit =
      setup_.singleScattering ? setup_.singleScattering->lit(stretch) : std::nullopt;
  if (lit) lightStretch(*lit, hit, start);
  const MediumFlight flight = fly(stretch);
  beta_ *= flight.weight;
  if (beta_.isBlack()) return false;
  if (!flight.collided && !isDirect_ && knowsTransmittance(bounces_))
    passed_.push_back({state_, stretch.tMin(), stretch.tMax()});
  // A path that media have dimmed on its way has little part in the variance. What is seen directly stays
  // exact.
  if (!flight.collided) return !(flight.weight.max() < 1) || bounces_ == 0 || playRoulette(/*inMedium=*/true);
  medium_ = {scatterPointOn(setup_.scene, ray_, flight.t, stretch.tMax(), hit, start, counters_),
             flight.phase,
             flight.t,
             stretch.tMin(),
             stretch.tMax(),
             lit ? std::optional(lit->extinction) : std::nullopt,
             flight.weight.max()};
  if (!isFinite(medium_.at.p)) return false;  // beyond what coordinates can tell: nothing is out there
  event = PathEvent::Medium;
  return false;
}

MediumFlight PathTracer::fly(const MediaStretch& stretch) {
  if (bounces_ >= kLedBounces) return stretch.sampleFreeFlight(beta_, context_.stream(), counters_);
  const LedFlight led(context_.rng, context_.pixelSample, ledFlights_);
  const MediumFlight flight = stretch.sampleFreeFlight(beta_, context_.stream(), counters_);
  if (led.isTaken()) ++ledFlights_;  // what is empty has no part in the order
  return flight;
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
void PathTracer::followChannels(const Way& way) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (beta_[c] == 0) continue;
    PathTracer one(*this);
    one.radiance_ = Rgb();
    one.beta_ = Rgb();
    one.beta_[c] = beta_[c];
    Way rest{{way.walk, one.walkContext(), one.state_}, way.start, way.passedEmitters};
    radiance_ += one.scatterFrom(one.followWay(rest));
  }
}

SurfaceInteraction PathTracer::surfaceAt(const SceneHit& hit) const {
  SurfaceInteraction si = setup_.scene.surface(hit, ray_);
  if (ray_.hasDifferentials && hit.primitive->material) si.computeDifferentials(ray_);
  return si;
}

bool PathTracer::scatterOnSurface() {
  ++counters_.surfaceScatterings;
  samples_.startVertex(bounces_);
  SurfaceInteraction& si = surface_.si;
  const Material& material = *surface_.hit.primitive->material;
  Bsdf bsdf = material.bsdf(si, TransportMode::Radiance, /*mergeSpecular=*/true);
  if (layers_ && bounces_ == 0) tellSurface(bsdf);
  if (material.hasBssrdf() && !indirect_) bsdf.separateSubsurface();
  if (bsdf.count(BsdfFlags::AllButSpecular) > 0) lightSurface(bsdf);

  const LobeChoice choice = askForIndirectLight(bsdf);
  BsdfSample sample = bsdf.sample(si.wo, choice.u, choice.lobes);
  sample.pdf *= choice.share;
  if (!(sample.pdf > 0) || sample.f.isBlack()) return false;
  beta_ *= sample.f * (absDot(sample.wi, bsdf.shadingNormal()) / sample.pdf);
  if (beta_.isBlack()) return false;
  return any(sample.flags & BsdfFlags::Subsurface) ? scatterBelowSurface() : leaveSurface(bsdf, sample);
}

/// From where the path went below a surface to where it leaves it again: one scattering, as in PBRT-v3. The
/// radiance scaling of going in undoes that of coming out, so roulette need not know of either.
bool PathTracer::scatterBelowSurface() {
  const Material& material = *surface_.hit.primitive->material;
  const std::optional<Bssrdf> bssrdf = material.bssrdf(surface_.si);
  if (!bssrdf) return false;
  const float uWay = samples_.get1D();
  const std::optional<SubsurfaceEmergence> out = sampleEmergence(
      setup_.scene, *bssrdf, surface_.si, ray_.time, material, uWay, samples_.get2D(), counters_.rays);
  if (!out) return false;
  beta_ *= out->weight;
  if (beta_.isBlack()) return false;
  if (setup_.media && setup_.scene.hasMediumBoundaries()) {
    passMediaBelow(walkContext(), state_, {surface_.hit, surface_.si, surface_.coincident}, *out, ray_.time);
  }
  surface_ = {out->hit, out->si, {}};
  SurfaceInteraction& si = surface_.si;
  si.wo = Vector3f(si.shading.n);
  Bsdf bsdf(si, TransportMode::Radiance);
  bsdf.add(Lobe(Rgb(1), RareLobe(SubsurfaceExit(bssrdf->eta(), /*isRadiance=*/true))));
  lightSurface(bsdf);
  const BsdfSample sample = bsdf.sample(si.wo, samples_.get2D());
  if (!(sample.pdf > 0) || sample.f.isBlack()) return false;
  beta_ *= sample.f * (absDot(sample.wi, bsdf.shadingNormal()) / sample.pdf);
  return leaveSurface(bsdf, sample);
}

bool PathTracer::leaveSurface(const Bsdf& bsdf, const BsdfSample& sample) {
  const SurfaceInteraction& si = surface_.si;
  isDirect_ = any(sample.flags & BsdfFlags::Specular);
  directionPdf_ = sample.pdf;
  if (isDirect_ && any(sample.flags & BsdfFlags::Transmission) &&
      dot(sample.wi, si.n) * dot(si.wo, si.n) < 0) {
    const float eta2 = sqr(bsdf.eta());
    etaScale_ *= dot(si.wo, si.n) > 0 ? eta2 : 1 / eta2;
  }
  ++bounces_;
  if (setup_.media) {
    setup_.media->leaveSurface(state_, surface_.hit, si, surface_.coincident, sample.wi, counters_,
                               context_.mismatches);
  }
  BoundaryPlane plane;
  if (!state_.isVacuum()) plane = planeAt(surface_.hit, si, Vec3d(si.p), sample.wi, ray_.time);
  startSegment(si.p, sample.wi, plane, surface_.coincident.startingWith(surface_.hit.hit.id));
  return playRoulette(/*inMedium=*/false);
}

/// Which lobes the path goes on with. Those that are not specular may end it at the next light.
PathTracer::LobeChoice PathTracer::askForIndirectLight(const Bsdf& bsdf) {
  LobeChoice choice{.u = samples_.get2D()};
  if (!indirect_ || bsdf.count(BsdfFlags::AllDiffuse) == 0) return choice;
  const std::size_t lobes = bsdf.count(), specular = lobes - bsdf.count(BsdfFlags::AllButSpecular);
  if (specular > 0) {
    const float share = static_cast<float>(specular) / static_cast<float>(lobes);
    if (choice.u.x < share) {
      return {BsdfFlags::Specular | BsdfFlags::Reflection | BsdfFlags::Transmission,
              share,
              {std::min(choice.u.x / share, kOneMinusEpsilon), choice.u.y}};
    }
    choice.share = 1 - share;
    choice.u.x = std::min((choice.u.x - share) / choice.share, kOneMinusEpsilon);
  }
  choice.lobes = BsdfFlags::AllButSpecular;
  lastVertex_ = bounces_ + 1;
  radiance_ += beta_ * indirect_->scatteredOnSurface(surface_.si, bsdf, lastVertex_) / choice.share;
  return choice;
}

bool PathTracer::scatterInMedium() {
  ++counters_.mediumScatterings;
  if (inPlace_.isStuck(ray_.o, medium_.at)) {
    ++counters_.stuckPaths;
    return false;
  }
  samples_.startVertex(bounces_);
  if (layers_ && bounces_ == 0) tellScattering();
  lightMedium();
  if (indirect_) {
    const Rgb sigmaS = MediaStretch(state_, ray_, medium_.tMin, medium_.tMax).sigmaS(medium_.t, counters_);
    lastVertex_ = bounces_ + 1;
    radiance_ +=
        beta_ * indirect_->scatteredInMedium(medium_.at.p, -ray_.d, *medium_.phase, sigmaS, lastVertex_);
  }
  const PhaseFunction::Sample sample = medium_.phase->sample(-ray_.d, samples_.get2D());
  if (!(sample.value > 0)) return false;
  isDirect_ = false;
  directionPdf_ = sample.value;
  ++bounces_;
  startSegment(medium_.at.p, sample.wi, medium_.at.near, {});
  from_ = medium_.at;
  return playRoulette(/*inMedium=*/true);
}

void PathTracer::startSegment(Point3f o, Vector3f d, const BoundaryPlane& plane, const Exclusions& start) {
  const float time = ray_.time;
  ray_ = RayDifferential();
  ray_.o = o;
  ray_.d = d;
  ray_.time = time;
  startPlane_ = plane;
  rayStart_ = start;
  from_ = {};
  passed_.clear();
}

bool PathTracer::playRoulette(bool inMedium) {
  const float threshold = setup_.params.rrThreshold;
  const float weight = largestChannel(beta_) * etaScale_;
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
