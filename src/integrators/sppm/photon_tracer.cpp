// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/sppm/photon_tracer.h"

#include <algorithm>

#include "base/bounds.h"
#include "base/warp.h"
#include "materials/bsdf.h"
#include "materials/material.h"
#include "spectrum/largest_channel.h"
#include "world/boundary_planes.h"
#include "world/medium_light.h"
#include "world/state_at_start.h"
#include "world/visibility.h"

namespace pbrtmedia {
namespace {

/// Relative to the power of their start, that of light paths below which roulette thins them out. At each
/// loss (1) photons are all alike and few; far below, paths take long to end that bring little.
constexpr float kPhotonRouletteWeight = 0.5f;

/// How far along an endless ray there may be something of the media of a state.
double reachOf(const MediumState& state, const Ray& ray) {
  double reach = 0;
  for (std::size_t i = 0; i < state.activeCount(); ++i) {
    const PlacedMedium m = state.active(i);
    const Bounds3f box = m.medium->bounds();
    if (box.isEmpty()) continue;
    Segment line{ray.o, ray.d, 0, static_cast<double>(kInfinity)};
    if (m.placement) line = m.placement->toObject(line, ray.time);
    const auto within = clipToBox(Bounds3d{Vec3d(box.min), Vec3d(box.max)}, Vec3d(line.o), Vec3d(line.d),
                                  line.tMin, line.tMax);
    if (within) reach = std::max(reach, within->tMax);
  }
  return reach;
}

}  // namespace

void PhotonTracer::trace(Photons& out) {
  if (!leaveLight()) return;
  for (;;) {
    switch (flyToEvent()) {
      case PathEvent::End:
        return;
      case PathEvent::Surface:
        if (!scatterOnSurface(out)) return;
        break;
      case PathEvent::Medium:
        if (!scatterInMedium(out)) return;
        break;
    }
  }
}

bool PhotonTracer::leaveLight() {
  const Scene& scene = setup_.scene;
  const LightSelector::Choice choice = setup_.selector.choose(Point3f(), sampler_.get1D());
  const Point2f uPosition = sampler_.get2D(), uDirection = sampler_.get2D();
  if (const MediumLight* const medium = scene.mediumLight(choice.light))
    return leaveMedium(*medium, choice.probability, uPosition, uDirection);
  const Light& light = *scene.lights()[choice.light];
  const LeSample sample = light.sampleLe(uPosition, uDirection, setup_.time);
  if (!(sample.pdf.direction > 0) || !(sample.pdf.position > 0) || sample.radiance.isBlack()) return false;
  power_ = sample.radiance * (absDot(sample.normal, sample.ray.d) /
                              (choice.probability * sample.pdf.position * sample.pdf.direction));
  if (power_.isBlack()) return false;
  ray_ = sample.ray;
  ray_.time = setup_.time;
  hider_ = scene.hiderOf(choice.light);
  const PrimitiveId target = scene.lightTarget(choice.light);
  if (target.isValid()) rayStart_ = Exclusions(target);
  startSize_ = largestChannel(power_);
  if (setup_.media) state_ = stateAtLight(light);
  return !power_.isBlack();
}

/// From a point inside an emissive medium, in any direction.
bool PhotonTracer::leaveMedium(const MediumLight& light, float probability, Point2f uPosition,
                               Point2f uDirection) {
  ray_.o = light.samplePoint(uPosition, setup_.time);
  ray_.d = sampleUniformSphere(uDirection);
  ray_.time = setup_.time;
  ray_.tMax = kInfinity;
  const double pdf = light.pointPdf(ray_.o, setup_.time) * double{probability};
  if (!setup_.media || !(pdf > 0)) return false;
  state_ = setup_.media->stateAt(ray_.o, setup_.time, counters_);
  for (std::size_t i = 0; i < state_.activeCount(); ++i) {
    if (state_.active(i) == light.medium()) source_ = i;
  }
  const Rgb emission = light.emissionAt(ray_.o, setup_.time, state_, counters_);
  power_ = emission * static_cast<float>(4 * double{kPi} / pdf);
  startSize_ = largestChannel(power_);
  return !power_.isBlack() && power_.isFinite();
}

/// What the first stretch of the ray lies in. Light from infinity is dimmed by what is around the scene.
MediumState PhotonTracer::stateAtLight(const Light& light) {
  const Scene& scene = setup_.scene;
  if (!scene.hasMediumBoundaries() && setup_.media->camera().state().isVacuum()) return {};
  MediumState state = stateAtStart(*setup_.media, ray_, rayStart_, counters_);
  if (!light.isAtInfinity() || state.isVacuum()) return state;
  Ray back = ray_;
  back.d = -ray_.d;
  if (!state.isExponential()) {
    // What is around the scene dims as a whole there: light starts behind it.
    const double reach = reachOf(state, back);
    if (reach < static_cast<double>(kInfinity)) {
      ray_.o = Point3f(Vec3d(back.o) + reach * Vec3d(back.d));
    } else {
      power_ = Rgb();
    }
    return state;
  }
  MediumState end = state;
  power_ *= shadowTransmittance(walkContext(), {back, {}}, end, PixelStream(rng_));
  return state;
}

PathEvent PhotonTracer::flyToEvent() {
  MediaWalk walk(walkContext(), state_, LineWalk(setup_.scene, ray_, rayStart_), &from_);
  BoundaryPlane start = startPlane_;
  for (;;) {
    const SceneHit* const nearest = walk.ahead();
    if (!state_.isVacuum()) {
      if (collides(walk, nearest, start)) return isFinite(medium_.at.p) ? PathEvent::Medium : PathEvent::End;
      if (power_.isBlack()) return PathEvent::End;
    }
    const std::optional<SceneHit> hit = walk.next();
    if (!hit || (scatterings_ == 0 && hit->isHider(hider_))) return PathEvent::End;
    if (!hit->primitive->material && !setup_.media) {
      walk.cross(*hit);
      source_.reset();
      continue;
    }
    const SurfaceInteraction si = setup_.scene.surface(*hit, ray_);
    if (hit->primitive->material) {
      surface_ = {*hit, si, {}};
      if (setup_.media && setup_.scene.hasMediumBoundaries())
        surface_.coincident = walk.coincidentWith(*hit, si);
      return PathEvent::Surface;
    }
    start = planeAt(*hit, si, Vec3d(ray_.o) + walk.tEnd() * Vec3d(ray_.d), ray_.d, ray_.time);
    walk.cross(*hit, si);
    source_.reset();
  }
}

/// Flies through the stretch at hand.
bool PhotonTracer::collides(const MediaWalk& walk, const SceneHit* nearest, const BoundaryPlane& start) {
  const MediaStretch stretch = walk.stretch();
  const MediumFlight flight = stretch.sampleFlightOfLight(source_, power_, PixelStream(rng_), counters_);
  power_ *= flight.weight;
  if (!flight.collided || power_.isBlack()) return false;
  medium_ = {scatterPointOn(setup_.scene, ray_, flight.t, stretch.tMax(), nearest, start, counters_),
             flight.phase, stretch.sigmaS(flight.t, counters_), flight.medium};
  return true;
}

bool PhotonTracer::scatterOnSurface(Photons& out) {
  ++counters_.surfaceScatterings;
  SurfaceInteraction& si = surface_.si;
  const Bsdf bsdf =
      surface_.hit.primitive->material->bsdf(si, TransportMode::Importance, /*mergeSpecular=*/true);
  if (storesHere() && bsdf.count(BsdfFlags::AllDiffuse) > 0)
    out.onSurfaces.push_back({{si.p, si.wo, power_, scatterings_}, absDot(si.wo, si.n)});
  if (!mayScatter()) return false;
  const BsdfSample sample = bsdf.sample(si.wo, uniformSquare());
  if (!(sample.pdf > 0) || sample.f.isBlack()) return false;
  power_ *= sample.f * (absDot(sample.wi, bsdf.shadingNormal()) / sample.pdf);
  if (power_.isBlack()) return false;
  if (setup_.media) {
    setup_.media->leaveSurface(state_, surface_.hit, si, surface_.coincident, sample.wi, counters_, nullptr);
  }
  BoundaryPlane plane;
  if (!state_.isVacuum()) plane = planeAt(surface_.hit, si, Vec3d(si.p), sample.wi, ray_.time);
  startSegment(si.p, sample.wi, plane, surface_.coincident.startingWith(surface_.hit.hit.id));
  return playRoulette();
}

bool PhotonTracer::scatterInMedium(Photons& out) {
  ++counters_.mediumScatterings;
  if (storesHere()) out.inMedia.push_back({{medium_.at.p, -ray_.d, power_, scatterings_}, medium_.sigmaS});
  if (!mayScatter()) return false;
  if (inPlace_.isStuck(ray_.o, medium_.at)) {
    ++counters_.stuckPaths;
    return false;
  }
  const PhaseFunction::Sample sample = medium_.phase->sample(-ray_.d, uniformSquare());
  if (!(sample.value > 0)) return false;
  startSegment(medium_.at.p, sample.wi, medium_.at.near, {});
  from_ = medium_.at;
  source_ = medium_.number;
  return playRoulette();
}

void PhotonTracer::startSegment(Point3f o, Vector3f d, const BoundaryPlane& plane, const Exclusions& start) {
  ray_.o = o;
  ray_.d = d;
  ray_.tMax = kInfinity;
  startPlane_ = plane;
  rayStart_ = start;
  from_ = {};
  source_.reset();
  ++scatterings_;
}

Point2f PhotonTracer::uniformSquare() {
  const float x = rng_.uniform();
  return {x, rng_.uniform()};
}

bool PhotonTracer::playRoulette() {
  const float survival = largestChannel(power_) / (kPhotonRouletteWeight * startSize_);
  if (!(survival < 1)) return true;
  if (!(rng_.uniform() < survival)) return false;
  power_ /= survival;
  return true;
}

}  // namespace pbrtmedia
