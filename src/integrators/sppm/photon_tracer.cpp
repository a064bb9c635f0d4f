// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/sppm/photon_tracer.h"

#include <algorithm>
#include <cmath>

#include "base/interruption.h"
#include "materials/bsdf.h"
#include "materials/material.h"
#include "world/boundary_planes.h"
#include "world/visibility.h"

namespace pbrtmedia {
namespace {

/// Scatterings that take good dimensions of the sampler, as many as of camera paths.
constexpr int kSampledScatterings = 8;
/// After so many scatterings in one place free flights are far shorter than coordinates can tell; close to a
/// boundary, heights above it are told far better (as in PathTracer).
constexpr int kMostInPlace = 1024, kMostAtBoundary = 1 << 20;

float largest(Rgb power) { return std::max(std::abs(power.max()), std::abs(power.min())); }

}  // namespace

void PhotonTracer::trace(Photons& out) {
  if (!leaveLight()) return;
  for (;;) {
    switch (flyToEvent()) {
      case Event::End:
        return;
      case Event::Surface:
        if (!scatterOnSurface(out)) return;
        break;
      case Event::Medium:
        if (!scatterInMedium(out)) return;
        break;
    }
  }
}

bool PhotonTracer::leaveLight() {
  const Scene& scene = setup_.scene;
  const LightSelector::Choice choice = setup_.selector.choose(Point3f(), sampler_.get1D());
  const Light& light = *scene.lights()[choice.light];
  const Point2f uPosition = sampler_.get2D(), uDirection = sampler_.get2D();
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
  strength_ = largest(power_);
  if (setup_.media) state_ = stateAtLight(light, sample);
  return !power_.isBlack();
}

/// What the first stretch of the ray lies in, told halfway to its end, off the surface that the light may be
/// on. Light from infinity is dimmed by what is around the scene.
MediumState PhotonTracer::stateAtLight(const Light& light, const LeSample& sample) {
  const Scene& scene = setup_.scene;
  if (!scene.hasMediumBoundaries() && setup_.media->camera().state().isVacuum()) return {};
  const std::optional<SceneHit> first = scene.closest(ray_, 0, rayStart_, counters_.rays);
  const float half = first ? first->t() / 2 : std::max(1.0f, scene.largestCoordinate());
  MediumState state = setup_.media->stateAt(sample.ray.at(half), setup_.time, counters_);
  const bool isFromInfinity = light.isInfinite() || (light.isDelta() && !light.deltaPosition());
  if (!isFromInfinity || state.isVacuum()) return state;
  Ray back = ray_;
  back.d = -ray_.d;
  MediumState end = state;
  power_ *= shadowTransmittance(walkContext(), {back, {}}, end, PixelStream(rng_));
  return state;
}

PhotonTracer::Event PhotonTracer::flyToEvent() {
  MediaWalk walk(walkContext(), state_, LineWalk(setup_.scene, ray_, rayStart_), &from_);
  BoundaryPlane start = startPlane_;
  for (;;) {
    leaveIfAbandoned();
    const SceneHit* const nearest = walk.ahead();
    if (!state_.isVacuum()) {
      if (collides(walk, nearest, start)) return isFinite(medium_.at.p) ? Event::Medium : Event::End;
      if (power_.isBlack()) return Event::End;
    }
    const std::optional<SceneHit> hit = walk.next();
    if (!hit || (scatterings_ == 0 && hit->isHider(hider_))) return Event::End;
    if (!hit->primitive->material && !setup_.media) {
      walk.cross(*hit);
      continue;
    }
    const SurfaceInteraction si = setup_.scene.surface(*hit, ray_);
    if (hit->primitive->material) {
      surface_ = {*hit, si, {}};
      if (setup_.media && setup_.scene.hasMediumBoundaries())
        surface_.coincident = walk.coincidentWith(*hit, si);
      return Event::Surface;
    }
    start = planeAt(*hit, si, Vec3d(ray_.o) + walk.tEnd() * Vec3d(ray_.d), ray_.d, ray_.time);
    walk.cross(*hit, si);
  }
}

/// Flies through the stretch at hand.
bool PhotonTracer::collides(const MediaWalk& walk, const SceneHit* nearest, const BoundaryPlane& start) {
  const MediaStretch stretch = walk.stretch();
  const MediumFlight flight = stretch.sampleFreeFlight(power_, PixelStream(rng_), counters_);
  power_ *= flight.weight;
  if (!flight.collided || power_.isBlack()) return false;
  medium_ = {scatterPointOn(setup_.scene, ray_, flight.t, stretch.tMax(), nearest, start, counters_),
             flight.phase, stretch.sigmaS(flight.t, counters_)};
  return true;
}

bool PhotonTracer::scatterOnSurface(Photons& out) {
  ++counters_.surfaceScatterings;
  SurfaceInteraction& si = surface_.si;
  const Bsdf bsdf =
      surface_.hit.primitive->material->bsdf(si, TransportMode::Importance, /*mergeSpecular=*/true);
  constexpr BsdfFlags kDiffuse = BsdfFlags::Diffuse | BsdfFlags::Reflection | BsdfFlags::Transmission;
  if (storesHere() && bsdf.count(kDiffuse) > 0) out.onSurfaces.push_back({si.p, si.wo, power_, scatterings_});
  if (!mayScatter()) return false;
  const BsdfSample sample = bsdf.sample(si.wo, directionSample());
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
  inPlace_ = medium_.at.p == ray_.o ? inPlace_ + 1 : 0;
  if (inPlace_ > (medium_.at.near.isValid ? kMostAtBoundary : kMostInPlace)) {
    ++counters_.stuckPaths;
    return false;
  }
  const PhaseFunction::Sample sample = medium_.phase->sample(-ray_.d, directionSample());
  if (!(sample.value > 0)) return false;
  startSegment(medium_.at.p, sample.wi, medium_.at.near, {});
  from_ = medium_.at;
  return playRoulette();
}

void PhotonTracer::startSegment(Point3f o, Vector3f d, const BoundaryPlane& plane, const Exclusions& start) {
  ray_.o = o;
  ray_.d = d;
  ray_.tMax = kInfinity;
  startPlane_ = plane;
  rayStart_ = start;
  from_ = {};
  ++scatterings_;
}

Point2f PhotonTracer::directionSample() {
  if (scatterings_ < kSampledScatterings) return sampler_.get2D();
  const float x = rng_.uniform();
  return {x, rng_.uniform()};
}

bool PhotonTracer::playRoulette() {
  const float survival = largest(power_) / strength_;
  if (survival < 1) {
    if (!(rng_.uniform() < survival)) return false;
    power_ /= survival;
  }
  strength_ = largest(power_);
  return true;
}

}  // namespace pbrtmedia
