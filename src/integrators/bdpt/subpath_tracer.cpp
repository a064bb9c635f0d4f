// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/bdpt/subpath_tracer.h"

#include <algorithm>

#include "base/warp.h"
#include "integrators/bdpt/light_surroundings.h"
#include "integrators/bdpt/strands.h"
#include "materials/bssrdf.h"
#include "materials/material.h"
#include "materials/subsurface_exit.h"
#include "spectrum/largest_channel.h"
#include "world/boundary_planes.h"
#include "world/media_below.h"
#include "world/medium_light.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kMostReserved = 16;

/// Density per solid angle of `wo` given `wi` relative to that of `wi` given `wo`, for a lobe without extent:
/// eta² cos d(direction) is the same on both sides of a surface.
double specularPdfBack(const Bsdf& bsdf, const SurfaceInteraction& si, Vector3f wi) {
  const double cosO = absDot(si.wo, bsdf.shadingNormal()), cosI = absDot(wi, bsdf.shadingNormal());
  if (!(cosI > 0)) return 1;
  const float outside = dot(si.wo, si.n);
  const double eta = outside * dot(wi, si.n) < 0 ? double{bsdf.eta()} : 1;
  return cosO / cosI * (outside > 0 ? 1 / sqr(eta) : sqr(eta));
}

}  // namespace

Subpath SubpathTracer::fromCamera(const Ray& ray, const MediumState& state, bool isSeen, WePdf pdf,
                                  FoundRadiance& found, bool looksBeyond) {
  found_.emplace(setup_, context_, path_, way_, found);
  looksBeyond_ = looksBeyond;
  path_.firstOthers = isSeen ? 1 : 0;
  pdfCamera_ = pdf;
  way_.ray = ray;
  state_ = state;
  trace();
  return std::move(path_);
}

std::optional<Subpath> SubpathTracer::fromLight(const Ray& toCamera, const MediumState& atCamera) {
  path_.fromLight = true;
  if (!setup_.startSelector || setup_.maxDepth == 0) return std::nullopt;
  const LightSelector::Choice choice = setup_.startSelector->choose(toCamera.o, context_.sampler.get1D());
  const Point2f uPosition = context_.sampler.get2D(), uDirection = context_.sampler.get2D();
  if (setup_.scene.mediumLight(choice.light)) {
    way_.ray.time = toCamera.time;
    if (!startInMedium(choice, uPosition, uDirection, toCamera.o, atCamera)) return std::nullopt;
    trace();
    return std::move(path_);
  }
  const Light& light = *setup_.scene.lights()[choice.light];
  if (!setup_.weights.startsOn(light)) return std::nullopt;
  const LeSample s = light.sampleLe(uPosition, uDirection, toCamera.time);
  const float pdf = choice.probability * s.pdf.position * s.pdf.direction;
  if (!(pdf > 0) || s.radiance.isBlack()) return std::nullopt;
  const PrimitiveId target = setup_.scene.lightTarget(choice.light);
  LightSurroundings around =
      surroundingsOf(setup_, target, light.isAtInfinity(), s.ray, s.normal, toCamera.o, atCamera, context_);
  way_.ray = s.ray;
  rayStart_ = around.start;
  startPlane_ = around.plane;
  state_ = std::move(around.state);
  way_.beta = s.radiance * (absDot(s.normal, s.ray.d) / pdf);
  path_.light = {.index = choice.light,
                 .light = &light,
                 .p = s.ray.o,
                 .n = s.normal,
                 .d = -s.ray.d,
                 .isArea = target.isValid()};
  trace();
  return std::move(path_);
}

/// From a point inside an emissive medium, in any direction.
bool SubpathTracer::startInMedium(const LightSelector::Choice& choice, Point2f uPosition, Point2f uDirection,
                                  Point3f camera, const MediumState& atCamera) {
  const MediumLight& light = *setup_.scene.mediumLight(choice.light);
  way_.ray.o = light.samplePoint(uPosition, way_.ray.time);
  way_.ray.d = sampleUniformSphere(uDirection);
  const double pdf =
      double{choice.probability} * light.pointPdf(way_.ray.o, way_.ray.time) * StrategyWeights::kAnyDirection;
  if (!setup_.media || !(pdf > 0)) return false;
  state_ =
      surroundingsOf(setup_, PrimitiveId{}, false, way_.ray, Normal3f(), camera, atCamera, context_).state;
  way_.beta =
      light.emissionAt(way_.ray.o, way_.ray.time, state_, context_.counters) * static_cast<float>(1 / pdf);
  path_.light = {.index = choice.light, .medium = &light, .p = way_.ray.o, .d = -way_.ray.d};
  return !way_.beta.isBlack() && way_.beta.isFinite();
}

void SubpathTracer::trace() {
  path_.vertices.reserve(std::min(kMostReserved, static_cast<std::size_t>(setup_.maxDepth)));
  firstSize_ = largestChannel(way_.beta);
  while (goOn() == Event::Vertex) {
    const bool isLast = !looksBeyond_ && seesOnlyEmission();
    const PathVertex& vertex = path_.vertices.back();
    // The last scattering may have another vertex, where light comes out from below.
    if (isLast && !(found_ && vertex.isOnSurface() && vertex.hit.primitive->material->hasBssrdf())) return;
    if (!scatter() || isLast) return;
  }
}

/// Follows the ray through boundaries without material to the next vertex.
SubpathTracer::Event SubpathTracer::goOn() {
  if (seesOnlyEmission()) {
    if (!found_ || (!setup_.scene.hasVisibleEmitters() && !setup_.mediaEmit)) return Event::End;
  }
  way_.depth = {};
  if (found_) found_->startWay();
  const bool isFromCamera = found_ && path_.vertices.empty();
  MediaWalk walk(setup_.walkContext(context_), state_,
                 isFromCamera ? LineWalk::fromCamera(setup_.scene, way_.ray)
                              : LineWalk(setup_.scene, way_.ray, rayStart_),
                 &from_);
  return follow(walk, startPlane_);
}

SubpathTracer::Event SubpathTracer::follow(MediaWalk& walk, BoundaryPlane start) {
  const std::uint32_t hider = path_.fromLight && path_.vertices.empty()
                                  ? setup_.scene.hiderOf(path_.light.index)
                                  : PrimitiveId::kNone;
  for (;;) {
    const SceneHit* const nearest = walk.ahead();
    if (seesOnlyEmission()) {
      const bool blocked = nearest && nearest->primitive->material && !nearest->isEmitter();
      if (blocked || (!nearest && setup_.scene.infiniteLights().empty())) {
        if (setup_.mediaEmit) found_->addMedia(walk.stretch(), state_);
        return Event::End;
      }
    }
    if (!state_.isVacuum()) {
      Event event = Event::End;
      if (!passMedium(walk.stretch(), nearest, start, event)) return event;
    }
    const std::optional<SceneHit> hit = walk.next();
    if (!hit) {
      if (found_) found_->addBackground();
      return Event::End;
    }
    if (hider != PrimitiveId::kNone && hit->isHider(hider)) return Event::End;
    const bool scatters = hit->primitive->material != nullptr;
    if (!scatters && !hit->isEmitter() && !setup_.media) {
      walk.cross(*hit);
      continue;
    }
    const SurfaceInteraction si = setup_.scene.surface(*hit, way_.ray);
    if (found_ && hit->isEmitter()) found_->addHit(*hit, si);
    if (scatters) {
      if (seesOnlyEmission()) return Event::End;
      if (path_.fromLight && setup_.hasStrands && isStrand(*hit->primitive)) return Event::End;
      addSurfaceVertex(walk, *hit, si);
      return Event::Vertex;
    }
    if (setup_.media) {
      start =
          planeAt(*hit, si, Vec3d(way_.ray.o) + walk.tEnd() * Vec3d(way_.ray.d), way_.ray.d, way_.ray.time);
    }
    walk.cross(*hit, si);
  }
}

/// The media between two surfaces, `hit` the one at the end. True: the path passes.
bool SubpathTracer::passMedium(const MediaStretch& stretch, const SceneHit* hit, const BoundaryPlane& start,
                               Event& event) {
  if (found_ && setup_.mediaEmit) found_->addMedia(stretch, state_);
  if (seesOnlyEmission()) {
    way_.beta *= stretch.transmittance(context_.stream(), context_.counters);
    way_.depth += stretch.control().depth;
    return !way_.beta.isBlack();
  }
  const MediumFlight flight = stretch.sampleFreeFlight(way_.beta, context_.stream(), context_.counters);
  way_.beta *= flight.weight;
  if (way_.beta.isBlack()) return false;
  if (!flight.collided) {
    way_.depth += stretch.control().depth;
    return true;
  }
  addMediumVertex(stretch, flight, hit, start);
  if (isFinite(path_.vertices.back().p)) {
    event = Event::Vertex;
  } else {
    path_.vertices.pop_back();  // beyond what coordinates can tell: nothing is out there
  }
  return false;
}

void SubpathTracer::addMediumVertex(const MediaStretch& stretch, const MediumFlight& flight,
                                    const SceneHit* hit, const BoundaryPlane& start) {
  const FlightControl control = stretch.upTo(flight.t).control();
  way_.depth += control.depth;
  PathVertex& vertex = addVertex();
  vertex.at = scatterPointOn(setup_.scene, way_.ray, flight.t, stretch.tMax(), hit, start, context_.counters);
  vertex.p = vertex.at.p;
  vertex.phase = flight.phase;
  vertex.wo = -way_.ray.d;
  const float mean = control.rate.average();
  if (mean > 0) vertex.rate = control.rate / mean;
  findDensity();
}

void SubpathTracer::addSurfaceVertex(MediaWalk& walk, const SceneHit& hit, const SurfaceInteraction& si) {
  PathVertex& vertex = addVertex();
  vertex.hit = hit;
  vertex.si = si;
  if (setup_.media && setup_.scene.hasMediumBoundaries()) vertex.coincident = walk.coincidentWith(hit, si);
  vertex.bsdf = hit.primitive->material->bsdf(
      vertex.si, found_ ? TransportMode::Radiance : TransportMode::Importance, /*mergeSpecular=*/true);
  if (hit.primitive->material->hasBssrdf()) vertex.bsdf.separateSubsurface();
  vertex.p = si.p;
  vertex.wo = si.wo;
  findDensity();
}

/// With what the way brings. In place, as vertices are large.
PathVertex& SubpathTracer::addVertex() {
  const std::size_t number = path_.scatterings();
  PathVertex& vertex = path_.vertices.emplace_back();
  vertex.number = number;
  vertex.beta = way_.beta;
  vertex.state = state_;
  vertex.depth = way_.depth;
  return vertex;
}

/// Of the last vertex, which is complete otherwise.
void SubpathTracer::findDensity() {
  PathVertex& vertex = path_.vertices.back();
  const std::size_t before = path_.vertices.size() - 1;
  if (before > 0) {
    vertex.pdf =
        StrategyWeights::arrival(way_.pdfDirection, path_.vertices[before - 1].p, vertex, way_.depth);
  } else if (found_) {
    // Where light subpaths do not find the camera, all strategies share this factor.
    vertex.pdf = path_.firstOthers > 0
                     ? StrategyWeights::arrival(pdfCamera_, way_.ray.o, way_.ray.d, vertex, way_.depth)
                     : 1;
  } else {
    LightPoint& light = path_.light;
    if (light.medium) light.directionDensity = light.medium->directionPdf(vertex.p, light.d, way_.ray.time);
    light.emitted = setup_.weights.emitted(light, vertex.p, way_.ray.time);
    vertex.pdf = setup_.weights.departure(light, vertex, way_.depth, way_.ray.time);
    path_.firstOthers = squaredRatio(setup_.weights.looked(light, vertex.p), light.emitted);
  }
  if (found_ && setup_.hasStrands && vertex.isOnSurface() && isStrand(*vertex.hit.primitive)) {
    vertex.pdf = double{kInfinity};
  }
}

/// Chooses the way from the last vertex; false: the subpath ends there.
bool SubpathTracer::scatter() {
  PathVertex& vertex = path_.vertices.back();
  samples_.startVertex(static_cast<int>(vertex.number));
  return vertex.isOnSurface() ? scatterOnSurface(vertex) : scatterInMedium(vertex);
}

bool SubpathTracer::scatterOnSurface(PathVertex& vertex) {
  ++context_.counters.surfaceScatterings;
  const SurfaceInteraction& si = vertex.si;
  const BsdfSample sample = vertex.bsdf.sample(si.wo, samples_.get2D());
  if (!(sample.pdf > 0) || sample.f.isBlack()) return false;
  way_.beta *= sample.f * (absDot(sample.wi, vertex.bsdf.shadingNormal()) / sample.pdf);
  if (way_.beta.isBlack()) return false;
  return any(sample.flags & BsdfFlags::Subsurface) ? scatterBelowSurface() : leaveSurface(vertex, sample);
}

/// From where the path went below a surface to where it comes out again, as `volpath` does it. Light subpaths
/// end: the camera's find what comes out.
bool SubpathTracer::scatterBelowSurface() {
  if (path_.fromLight) return false;
  const PathVertex& entry = path_.vertices.back();
  const Material& material = *entry.hit.primitive->material;
  const std::optional<Bssrdf> bssrdf = material.bssrdf(entry.si);
  if (!bssrdf) return false;
  const float uWay = samples_.get1D();
  const std::optional<SubsurfaceEmergence> out =
      sampleEmergence(setup_.scene, *bssrdf, entry.si, way_.ray.time, material, uWay, samples_.get2D(),
                      context_.counters.rays);
  if (!out) return false;
  way_.beta *= out->weight;
  if (way_.beta.isBlack()) return false;
  if (setup_.media && setup_.scene.hasMediumBoundaries()) {
    passMediaBelow(setup_.walkContext(context_), state_, {entry.hit, entry.si, entry.coincident}, *out,
                   way_.ray.time);
  }
  PathVertex exit;
  exit.number = entry.number;
  exit.hit = out->hit;
  exit.si = out->si;
  exit.si.wo = Vector3f(exit.si.shading.n);
  exit.bsdf = Bsdf(exit.si, TransportMode::Radiance);
  exit.bsdf.add(Lobe(Rgb(1), RareLobe(SubsurfaceExit(bssrdf->eta(), /*isRadiance=*/true))));
  exit.p = exit.si.p;
  exit.wo = exit.si.wo;
  exit.beta = way_.beta;
  exit.state = state_;
  exit.pdf = double{kInfinity};
  path_.vertices.push_back(std::move(exit));
  PathVertex& vertex = path_.vertices.back();
  const BsdfSample sample = vertex.bsdf.sample(vertex.wo, samples_.get2D());
  if (!(sample.pdf > 0) || sample.f.isBlack()) return false;
  way_.beta *= sample.f * (absDot(sample.wi, vertex.bsdf.shadingNormal()) / sample.pdf);
  return leaveSurface(vertex, sample);
}

bool SubpathTracer::leaveSurface(PathVertex& vertex, const BsdfSample& sample) {
  const SurfaceInteraction& si = vertex.si;
  vertex.isSpecular = any(sample.flags & BsdfFlags::Specular);
  way_.pdfDirection = vertex.isSpecular ? 1 : double{sample.pdf};
  setup_.weights.scattersOn(path_, vertex.isSpecular ? specularPdfBack(vertex.bsdf, si, sample.wi)
                                                     : double{vertex.bsdf.pdf(sample.wi, si.wo)});
  if (setup_.media) {
    setup_.media->leaveSurface(state_, vertex.hit, si, vertex.coincident, sample.wi, context_.counters,
                               context_.mismatches);
  }
  startPlane_ = {};
  if (!state_.isVacuum()) startPlane_ = planeAt(vertex.hit, si, Vec3d(si.p), sample.wi, way_.ray.time);
  rayStart_ = vertex.coincident.startingWith(vertex.hit.hit.id);
  from_ = {};
  way_.ray.o = si.p;
  way_.ray.d = sample.wi;
  way_.ray.tMax = kInfinity;
  return playRoulette();
}

bool SubpathTracer::scatterInMedium(PathVertex& vertex) {
  ++context_.counters.mediumScatterings;
  if (inPlace_.isStuck(way_.ray.o, vertex.at)) {
    ++context_.counters.stuckPaths;
    return false;
  }
  const PhaseFunction::Sample sample = vertex.phase->sample(vertex.wo, samples_.get2D());
  if (!(sample.value > 0)) return false;
  way_.pdfDirection = double{sample.value};
  setup_.weights.scattersOn(path_, double{vertex.phase->evaluate(sample.wi, vertex.wo)});
  startPlane_ = vertex.at.near;
  rayStart_ = {};
  from_ = vertex.at;
  way_.ray.o = vertex.p;
  way_.ray.d = sample.wi;
  way_.ray.tMax = kInfinity;
  return playRoulette();
}

bool SubpathTracer::playRoulette() {
  const float weight = path_.fromLight ? setup_.roulette.light : setup_.roulette.camera;
  const float survival = largestChannel(way_.beta) / (weight * firstSize_);
  if (!(survival < 1)) return true;
  if (context_.rng.uniform() >= survival) return false;
  way_.beta /= survival;
  return true;
}

}  // namespace pbrtmedia
